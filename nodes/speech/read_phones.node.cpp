// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/read_phones.h"
#include "engine/node.h"

using namespace engine::declare;
using namespace face::speech;

NODE("speech.read_phones", &read_phones, version{1},
     doc{"Reads an alignment made elsewhere: TextGrid, phones.json, TIMIT's .phn, GRID's .align, or Rhubarb's JSON."},
     input{"file", "TextGrid with a tier \"phones\" (and \"words\"), phones.json, .phn, .align, or Rhubarb's .json"},
     input{"audio", "The recording, to find the bursts of stops"},
     output("phones", "Phones with their times, stops as closure and release"));
