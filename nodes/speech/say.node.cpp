// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/say.h"
#include "engine/node.h"

using namespace engine::declare;
using namespace face::speech;

NODE("speech.say", &say, version{1}, doc{"Speaks a text with flite; the phone times are the synthesiser's own."},
     input{"text", "What to say, English"},
     input{"dictionary", "CMU format: a warning tells how words that it lacks are spoken"},
     param("voice", &SayOptions::voice,
           {{"slt", Voice::slt}, {"rms", Voice::rms}, {"awb", Voice::awb}, {"kal", Voice::kal}},
           "slt: US woman; rms, kal: US men; awb: Scotsman"),
     param("duration_stretch", &SayOptions::duration_stretch, range{0.25, 4}, unit{"1"}, "2 speaks at half the speed"),
     output("audio", &SayResult::audio, "The sound, 16 kHz"),
     output("phones", &SayResult::phones, "Phones with their exact times, stops as closure and release"));
