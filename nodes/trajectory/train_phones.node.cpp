// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/train_phones.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face::trajectory;

NODE("trajectory.train_phones", &train_phones, version{2},
     doc{"Learns how a speaker moves: mean and covariance of the animation over the frames of every phone."},
     input{"weights", "Animation parameters of every frame; empty where they are not known"},
     input{"timeline", "When every frame is shown"}, input{"phones", "What is said when"},
     param("least_sigma", &TrainPhonesOptions::least_sigma, range{1e-6, 10}, unit{"1"},
           "Standard deviation that no direction falls below"),
     param("prior_frames", &TrainPhonesOptions::prior_frames, range{0, 100000}, unit{"1"},
           "Frames of all speech that every phone's covariance is mixed with"),
     param("closing_s", &TrainPhonesOptions::closing_s, range{0, 1}, unit{"s"},
           "For parameters that are 0 where the mouth is shut: time in which lips shut before P B M and part after it, "
           "which their neighbours are not blamed for; 0 = as published"),
     output("statistics", "One Gaussian per phone and one of all speech"));
