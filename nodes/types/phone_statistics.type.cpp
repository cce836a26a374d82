// SPDX-License-Identifier: Apache-2.0
#include "nodes/types/phone_statistics.h"

#include "engine/node.h"
using namespace engine::declare;
using namespace face;

TYPE(PhoneStatistics, "phone_statistics", codec_version{1}, doc{"Mean and covariance of the animation per phone."},
     field<&PhoneStatistics::phones>(field<&PhoneStatistic::label>(), field<&PhoneStatistic::frames>(),
                                     field<&PhoneStatistic::mean>(), field<&PhoneStatistic::covariance>()),
     field<&PhoneStatistics::all>(field<&PhoneStatistic::label>(), field<&PhoneStatistic::frames>(),
                                  field<&PhoneStatistic::mean>(), field<&PhoneStatistic::covariance>()));
