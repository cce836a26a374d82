// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/fit_phones.h"

#include "engine/node.h"
#include "nodes/types/audio.h"
#include "nodes/types/matrix.h"
#include "nodes/types/phones.h"
using namespace engine::declare;
using namespace face::speech;

NODE("speech.fit_phones", &fit_phones, version{1}, doc{"How well labels that were made elsewhere fit a recording."},
     input{"audio", "The recording, 16 kHz"}, input{"phones", "The labels"},
     input{"acoustic_model", "PocketSphinx acoustic model folder with the CMU phones, such as en-us"},
     output("scored", &FitPhonesResult::scored, "The labels, each with its mean log likelihood per frame"),
     output("apart_s", &FitPhonesResult::apart_s, "N x 1: from each phone's middle to where the sound has it"));
