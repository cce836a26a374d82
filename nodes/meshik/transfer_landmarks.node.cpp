// SPDX-License-Identifier: Apache-2.0
#include "nodes/meshik/transfer_landmarks.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::meshik;

NODE("meshik.transfer_landmarks", &transfer_landmarks, version{5},
     doc{"Where the mesh's landmarks have to be when the speaker's face is a mixture of key shapes."},
     input{"rig", "The head"}, input{"key_meshes", "The head in every key shape"},
     input{"key_shapes", "The speaker's key shapes"}, input{"weights", "The frame's weights of the key shapes"},
     input{"contact", "How sure it is that the lips meet in the frame, 0 to 1; without it, not at all"},
     input{"neutral",
           "The speaker's landmarks at rest; with it, small gaps between the lips are those that the key shapes show"},
     input{"frame", "The speaker's landmarks in the frame: how wide the mouth is in it; without them, as the mixture"},
     output("targets", "x and y of the landmark vertices"));
