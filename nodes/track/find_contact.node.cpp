// SPDX-License-Identifier: Apache-2.0
#include "nodes/track/find_contact.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::track;

NODE("track.find_contact", &find_contact, version{3}, doc{"Tells the frames in which the lips meet from the others."},
     input{"openings", "track.mouth_opening of every frame of a clip in which the lips meet somewhere"},
     input{"landmarks", "The points of every frame, with where the lips part; without it an F or V may count as shut"},
     param("shut_share", &FindContactOptions::shut_share, range{0, 1}, unit{"1"},
           "So many of the frames at least show lips that meet"),
     param("seam", &FindContactOptions::seam, range{0, 1}, unit{"1"},
           "What the seam of the best picture shows, in usual widths of a mouth: added to all openings"),
     param("most_shut", &FindContactOptions::most_shut, range{0, 1}, unit{"1"},
           "What lips that meet show at most, in usual widths of a mouth"),
     param("shut_ratio", &FindContactOptions::shut_ratio, range{1, 10}, unit{"1"},
           "Openings up to so many times theirs are shut"),
     param("open_ratio", &FindContactOptions::open_ratio, range{1, 10}, unit{"1"},
           "Openings from so many times theirs on are open"),
     param("tucked", &FindContactOptions::tucked, range{0, 10}, unit{"1"},
           "Share of the lower lip in both, as a share of usual, up to which it is behind the teeth"),
     param("untucked", &FindContactOptions::untucked, range{0, 10}, unit{"1"}, "The same from which on it is not"),
     output("contacts",
            "Of every frame: 1 where the lips meet, 0 where they do not, between them where it is doubtful"));
