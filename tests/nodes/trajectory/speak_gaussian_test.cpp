// SPDX-License-Identifier: Apache-2.0
#include "nodes/trajectory/speak_gaussian.h"

#include <gtest/gtest.h>

#include <cmath>

#include "nodes/base/random.h"
#include "nodes/trajectory/lips_shut.h"
#include "nodes/trajectory/train_phones.h"
#include "tests/support/expect_throw_text.h"

namespace {

using namespace face;
using namespace face::trajectory;

// Phones of 0.2 s; frames at 30 Hz whose weights scatter about a place of their phone's.
struct Training {
  Phones phones;
  Timeline timeline;
  std::vector<Weights> frames;

  explicit Training(double scatter) {
    Random random(9);
    const std::vector<std::pair<std::string, double>> said = {{"SIL", 0}, {"AA", 1}, {"P.c", -0.5}, {"P.r", 0.4}};
    for (std::size_t i = 0; i < 200; ++i) {
      const auto& [label, place] = said[i % 4];
      const double start_s = 0.2 * static_cast<double>(i);
      phones.phones.push_back({label, start_s, start_s + 0.2, "", 0});
      for (int f = 0; f < 6; ++f) {
        const double a = scatter * random.normal(), b = scatter * random.normal();
        frames.push_back({{static_cast<float>(place + a), static_cast<float>(2 * place + 0.9 * a + 0.1 * b)}});
        timeline.time_s.push_back(static_cast<double>(timeline.time_s.size()) / 30);
      }
    }
    phones.duration_s = timeline.duration_s = 40;
  }
  PhoneStatistics train(const TrainPhonesOptions& options = {}) const {
    return train_phones(engine::Seq<Weights>(frames), timeline, phones, options);
  }
};

std::vector<Weights> speak(const Phones& phones, const PhoneStatistics& statistics,
                           const SpeakGaussianOptions& options) {
  std::vector<Weights> frames;
  engine::SeqWriter<Weights> writer([&](const std::string&, Weights frame) { frames.push_back(std::move(frame)); });
  const Timeline timeline = speak_gaussian(phones, statistics, writer, options);
  EXPECT_EQ(timeline.time_s.size(), frames.size());
  return frames;
}

Phones sentence() {
  Phones phones;
  for (const char* label : {"SIL", "AA", "P.c", "P.r", "AA", "SIL"}) {
    const double start_s = phones.duration_s;
    phones.duration_s += 0.1;
    phones.phones.push_back({label, start_s, phones.duration_s, "", 0});
  }
  return phones;
}

TEST(TrainPhones, FindsTheMeanAndTheCovarianceOfEveryPhone) {
  TrainPhonesOptions options;
  options.prior_frames = 0;
  options.least_sigma = 1e-6;
  const PhoneStatistics found = Training(0.1).train(options);
  ASSERT_EQ(found.phones.size(), 4u);
  EXPECT_EQ(found.phones[0].label, "AA");
  EXPECT_EQ(found.phones[0].frames, 300);
  // 0.1 / sqrt(300) = 0.006 is the mean's own deviation.
  EXPECT_NEAR(found.phones[0].mean[0], 1, 0.02);
  EXPECT_NEAR(found.phones[1].mean[1], -1, 0.02);
  EXPECT_NEAR(found.phones[0].covariance[0], 0.01, 0.002);
  EXPECT_NEAR(found.phones[0].covariance[1], 0.009, 0.002);
  EXPECT_NEAR(found.phones[0].covariance[3], 0.0082, 0.002);
  EXPECT_EQ(found.phones[0].covariance[1], found.phones[0].covariance[2]);
  EXPECT_EQ(found.all.frames, 1200);
}

TEST(TrainPhones, KeepsEveryDirectionAboveTheFloor) {
  TrainPhonesOptions options;
  options.prior_frames = 0;
  options.least_sigma = 0.05;
  for (const PhoneStatistic& phone : Training(0).train(options).phones) {
    EXPECT_NEAR(phone.covariance[0], 0.0025, 1e-9);
    EXPECT_NEAR(phone.covariance[1], 0, 1e-9);
  }
}

TEST(TrainPhones, LeavesOutFramesWithoutWeights) {
  Training training(0);
  for (std::size_t f = 6; f < 10; ++f) training.frames[f].values.clear();
  EXPECT_EQ(training.train().phones[0].frames, 296);
  for (Weights& frame : training.frames) frame.values.clear();
  EXPECT_THROW_TEXT(training.train(), "no frame with weights lies within the phones");
}

TEST(TrainPhones, RejectsCountsThatDiffer) {
  Training training(0);
  training.timeline.time_s.pop_back();
  EXPECT_THROW_TEXT(training.train(), "there are 1200 frames of weights and 1199 times, expected as many");
  training = Training(0);
  training.frames[7].values.pop_back();
  EXPECT_THROW_TEXT(training.train(), "frame 7 has 1 weights, expected 2 as the first one");
}

TEST(SpeakGaussian, ReachesEveryMeanWithoutSmoothness) {
  const PhoneStatistics statistics = Training(0.1).train();
  SpeakGaussianOptions options;
  options.smoothness = 0;
  for (const CovarianceUse covariance : {CovarianceUse::diagonal, CovarianceUse::full}) {
    options.covariance = covariance;
    const std::vector<Weights> frames = speak(sentence(), statistics, options);
    ASSERT_EQ(frames.size(), 18u);
    EXPECT_NEAR(frames[4].values[0], find_statistic(statistics, "AA").mean[0], 1e-6);
    EXPECT_NEAR(frames[7].values[1], find_statistic(statistics, "P.c").mean[1], 1e-6);
  }
}

TEST(SpeakGaussian, FullAndDiagonalAgreeWhereParametersAreIndependent) {
  PhoneStatistics statistics = Training(0.1).train();
  for (PhoneStatistic& phone : statistics.phones) phone.covariance[1] = phone.covariance[2] = 0;
  const std::vector<Weights> diagonal = speak(sentence(), statistics, {});
  SpeakGaussianOptions options;
  options.covariance = CovarianceUse::full;
  const std::vector<Weights> full = speak(sentence(), statistics, options);
  for (std::size_t t = 0; t < full.size(); ++t)
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(full[t].values[k], diagonal[t].values[k], 1e-6);
}

TEST(SpeakGaussian, IsTheSameCurveAtTwiceTheRate) {
  const PhoneStatistics statistics = Training(0.3).train();
  SpeakGaussianOptions options;
  options.rate_hz = 120;
  const std::vector<Weights> slow = speak(sentence(), statistics, options);
  options.rate_hz = 240;
  const std::vector<Weights> fast = speak(sentence(), statistics, options);
  double least = 1, most = -1;
  for (std::size_t t = 0; t < slow.size(); ++t) {
    EXPECT_NEAR(fast[2 * t].values[0], slow[t].values[0], 0.05) << "frame " << t;
    least = std::min(least, static_cast<double>(slow[t].values[0]));
    most = std::max(most, static_cast<double>(slow[t].values[0]));
  }
  EXPECT_GT(most - least, 0.5);
}

TEST(SpeakGaussian, HoldsClosuresThatAPlainPathMisses) {
  const PhoneStatistics statistics = Training(0.3).train();
  const double closed = find_statistic(statistics, "P.c").mean[0];
  SpeakGaussianOptions options;
  const auto error = [&] { return std::abs(speak(sentence(), statistics, options)[8].values[0] - closed); };
  EXPECT_GT(error(), 0.1);
  const auto at_rest = [&] { return std::abs(speak(sentence(), statistics, options)[8].values[0]); };
  for (const CovarianceUse covariance : {CovarianceUse::diagonal, CovarianceUse::full}) {
    options.covariance = covariance;
    options.closures = Closures::trained;
    EXPECT_LT(error(), 1e-6);
    EXPECT_GT(at_rest(), 0.01);
    options.closures = Closures::rest;
    EXPECT_LT(at_rest(), 1e-6);
  }
}

TEST(SpeakGaussian, TakesTheNearestStatisticOfAPhoneThatWasNotSeen) {
  const PhoneStatistics statistics = Training(0.1).train();
  EXPECT_EQ(find_statistic(statistics, "P.r").label, "P.r");
  EXPECT_EQ(find_statistic(statistics, "P").label, "P.c");
  EXPECT_EQ(find_statistic(statistics, "AA.c").label, "AA");
  EXPECT_EQ(&find_statistic(statistics, "ZH"), &statistics.all);
  for (const char* label : {"B.c", "B", "M"}) EXPECT_EQ(find_statistic(statistics, label).label, "P.c") << label;
  EXPECT_EQ(find_statistic(statistics, "B.r").label, "P.r");
  PhoneStatistics of_m = statistics;
  of_m.phones = {find_statistic(statistics, "AA"), find_statistic(statistics, "AA")};
  of_m.phones[1].label = "M";
  EXPECT_EQ(find_statistic(of_m, "P.c").label, "M");
  EXPECT_EQ(find_statistic(of_m, "P.r").label, "");
}

// "abaSa" said again and again: A is 1, the lips of B shut and part within 0.1 s, S is 0.2.
struct Abasa {
  Phones phones;
  Timeline timeline;
  std::vector<Weights> frames;

  Abasa() {
    for (int i = 0; i < 40; ++i)
      for (const char* label : {"AA", "B.c", "AA", "S"}) {
        const double start_s = phones.duration_s;
        phones.duration_s += 0.16;
        phones.phones.push_back({label, start_s, phones.duration_s, "", 0});
      }
    timeline.duration_s = phones.duration_s;
    for (int f = 0; f < static_cast<int>(phones.duration_s * 30); ++f) {
      timeline.time_s.push_back(f / 30.0);
      const double middle_s = (f + 0.5) / 30;
      const auto phone = static_cast<std::size_t>(middle_s / 0.16);
      const std::string& label = phones.phones[std::min(phone, phones.phones.size() - 1)].label;
      const double wanted = label == "AA" ? 1 : label == "S" ? 0.2 : 0;
      frames.push_back({{static_cast<float>((1 - lips_shut(phones, middle_s, 0.1)) * wanted)}});
    }
  }
};

TEST(TrainPhones, DoesNotBlameAVowelForTheClosureBesideIt) {
  const Abasa said;
  const auto vowel = [&](double closing_s) {
    TrainPhonesOptions options;
    options.closing_s = closing_s;
    return train_phones(engine::Seq<Weights>(said.frames), said.timeline, said.phones, options).phones[0];
  };
  EXPECT_LT(vowel(0).mean[0], 0.8);
  EXPECT_NEAR(vowel(0.1).mean[0], 1, 1e-5);
  EXPECT_LT(vowel(0.1).frames, vowel(0).frames);
}

TEST(TrainPhones, KeepsThePlainMeanOfAPhoneThatIsNeverFree) {
  Abasa said;
  TrainPhonesOptions options;
  for (Phone& phone : said.phones.phones) {
    if (phone.label != "B.c") continue;
    phone.start_s -= 0.16;  // over the whole of the A before
    phone.end_s += 0.16;
  }
  const auto frames = engine::Seq<Weights>(said.frames);
  const PhoneStatistics plain = train_phones(frames, said.timeline, said.phones, options);
  options.closing_s = 0.01;
  const PhoneStatistics free = train_phones(frames, said.timeline, said.phones, options);
  ASSERT_EQ(free.phones.size(), plain.phones.size());
  EXPECT_EQ(free.phones[0].mean, plain.phones[0].mean);
}

TEST(LipsShut, RisesBeforeAClosureAndFallsAfterIt) {
  Phones phones;
  phones.phones = {{"AA", 0, 1, "", 0}, {"M", 1, 1.2, "", 0}, {"AA", 1.2, 2, "", 0}, {"T.c", 2, 2.1, "", 0}};
  EXPECT_EQ(lips_shut(phones, 0.89, 0.1), 0);
  EXPECT_NEAR(lips_shut(phones, 0.95, 0.1), 0.5, 1e-9);
  for (const double time_s : {1.0, 1.1, 1.2}) EXPECT_EQ(lips_shut(phones, time_s, 0.1), 1);
  EXPECT_NEAR(lips_shut(phones, 1.225, 0.1), 0.84375, 1e-9);
  EXPECT_EQ(lips_shut(phones, 2.05, 0.1), 0);
  EXPECT_EQ(lips_shut(phones, 0.99, 0), 0);
  EXPECT_EQ(lips_shut({}, 0, 0.1), 0);
}

TEST(SpeakGaussian, ShutsAndPartsLipsOverTheTimeThatTheyTake) {
  const Abasa said;
  TrainPhonesOptions train;
  train.closing_s = 0.1;
  const PhoneStatistics statistics = train_phones(engine::Seq<Weights>(said.frames), said.timeline, said.phones, train);
  SpeakGaussianOptions options;
  options.smoothness = 1e-3;
  options.closures = Closures::rest;
  const auto rms = [&] {
    const std::vector<Weights> spoken = speak(said.phones, statistics, options);
    double sum = 0;
    for (std::size_t t = 0; t + 1 < spoken.size(); ++t) {
      const double between = (said.frames[t].values[0] + said.frames[t > 0 ? t - 1 : 0].values[0]) / 2;
      sum += std::pow(static_cast<double>(spoken[t].values[0]) - between, 2);
    }
    return std::sqrt(sum / static_cast<double>(spoken.size()));
  };
  const double at_once = rms();
  options.closing_s = 0.1;
  EXPECT_LT(rms(), 0.5 * at_once);
}

TEST(SpeakGaussian, RejectsStatisticsThatAreNone) {
  engine::SeqWriter<Weights> writer([](const std::string&, const Weights&) {});
  EXPECT_THROW_TEXT(speak_gaussian({}, Training(0.1).train(), writer), "there are no phones to speak");
  PhoneStatistics statistics = Training(0.1).train();
  statistics.phones[2].mean.pop_back();
  EXPECT_THROW_TEXT(speak_gaussian(sentence(), statistics, writer),
                    "the statistic of \"P.r\" has 1 means and 4 covariances, expected 2 and 4");
}

}  // namespace
