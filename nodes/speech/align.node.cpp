// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/align.h"
#include "engine/node.h"

using namespace engine::declare;
using namespace face::speech;

NODE("speech.align", &align, version{1},
     doc{"When each phone of a recording is spoken: forced alignment of a text, or phone recognition without one."},
     input{"audio", "The recording, 16 kHz"},
     input{"text", "What is said, UTF-8; without it phones are recognised, with low confidence"},
     input{"acoustic_model", "PocketSphinx acoustic model folder with the CMU phones, such as en-us"},
     input{"dictionary", "Pronunciations in CMU format"},
     input{"phone_model", "PocketSphinx n-gram model over phones, used without a text"},
     param("match_score", &AlignOptions::match_score, range{-100, 0}, unit{"1"},
           "The text does not match where the mean log likelihood per frame is below this"),
     output("phones", &AlignResult::phones, "Phones with their times, stops as closure and release"),
     output("mean_score", &AlignResult::mean_score, "Mean log likelihood per frame of speech; lower is worse"),
     output("matches", &AlignResult::matches, "False where the text does not fit the sound"),
     output("report", &AlignResult::report, "How the text was read and where it does not fit, one line each"));
