// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_kernel.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE(
    "trajectory.speak_kernel", &speak_kernel, version{1},
    doc{"Turns timed phones into a path through a viseme space by Bargmann, Blanz and Seidel's kernel and motion blur, "
        "as published."},
    input{"phones", "What is said when"}, input{"statistics", "The visemes, from trajectory.train_phones"},
    param("blur", &SpeakKernelOptions::blur, {{"coordinates", Blur::coordinates}, {"none", Blur::none}},
          "Mean of four slots at 25 frames per second, or every slot at 100"),
    param("split_stops", &SpeakKernelOptions::split_stops,
          "Closure and release of a stop have visemes of their own; the paper has one"),
    output("timeline", "Time of every frame"), output("weights", "Coordinates of every frame"));
