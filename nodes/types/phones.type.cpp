// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/phones.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(Phones, "phones", codec_version{1}, doc{"The phones of a recording, with words and times."},
     field<&Phones::phones>(field<&Phone::label>(), field<&Phone::start_s>(), field<&Phone::end_s>(),
                            field<&Phone::word>(), field<&Phone::score>()),
     field<&Phones::duration_s>(), field<&Phones::confident>(), view{"TextGrid", "export.text_grid"},
     difference{"evaluate.phone_boundaries"});
