// SPDX-License-Identifier: Apache-2.0
// One store, many processes, and what must survive: kill -9, damage, and inputs that change.
#include <fcntl.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <thread>

#include "tests/end_to_end/command.h"

namespace {

using namespace std::chrono_literals;
using test::Words;
using test::operator+;

constexpr int processes = 8;

class SharedStore : public test::CommandTest {
 protected:
  void write_frames(int count) const {
    for (int i = 1; i <= count; ++i) write("frames/" + std::to_string(i) + ".txt", "frame " + std::to_string(i));
  }

  // The tasks that a process told of with an event; a line that was cut off tells of none.
  std::set<std::string> tasks_told(const std::string& name, const std::string& event) const {
    std::set<std::string> tasks;
    for (const std::string& line : test::lines_of(read(name))) {
      const nlohmann::json json = nlohmann::json::parse(line, nullptr, false);
      if (json.is_object() && json["event"] == event)
        tasks.insert(json["node"].get<std::string>() + "[" + json.value("element", "") + "]");
    }
    return tasks;
  }

  std::size_t tasks_run(const std::string& summary) const {
    return nlohmann::json::parse(read(summary), nullptr, false)["tasks"]["run"].get<std::size_t>();
  }
};

// Every round changes some frames and kills each of eight processes at a moment of its own.
TEST_F(SharedStore, OutlivesProcessesThatAreKilled) {
  constexpr int frames = 300;
  const char* const full = std::getenv("FACEGRAPH_FULL");
  const int rounds = full && std::string(full) == "1" ? 200 : 20;
  std::mt19937 random(20);
  std::vector<std::string> texts(frames);
  std::size_t reported = 0, killed_early = 0;
  // Between two kills; on a machine that is busy work takes longer to begin.
  std::chrono::microseconds longest_pause = std::chrono::milliseconds(16);
  for (int round = 0; round < rounds; ++round) {
    std::string truth;
    for (int i = 0; i < frames; ++i) {
      if (round == 0 || random() % 2 == 0) {
        texts[static_cast<std::size_t>(i)] = "FRAME " + std::to_string(i) + " OF ROUND " + std::to_string(round);
        write("frames/" + std::to_string(i) + ".txt", texts[static_cast<std::size_t>(i)]);
      }
      truth += (i == 0 ? "" : "\n") + texts[static_cast<std::size_t>(i)];
    }
    const Words words = {"run", graph("toy/frames.json"), "--set", "folder=frames", "--quiet", "--threads", "2"};
    std::vector<pid_t> children;
    for (int p = 0; p < processes; ++p) {
      const std::string events = "events" + std::to_string(p) + ".ndjson";
      std::filesystem::remove(path(events));  // of the round before: who is killed at once writes none
      children.push_back(start(words + Words{"--events", events}));
    }
    for (const pid_t child : children) {
      std::this_thread::sleep_for(longest_pause * (random() % 16) / 16);
      ::kill(child, SIGKILL);
    }
    for (const pid_t child : children) killed_early += wait(child).code == 128 + SIGKILL;
    std::set<std::string> finished;
    for (int p = 0; p < processes; ++p)
      finished.merge(tasks_told("events" + std::to_string(p) + ".ndjson", "finished"));
    reported += finished.size();

    const auto start_of_fresh = std::chrono::steady_clock::now();
    const test::Ended fresh = command(words + Words{"--events", "fresh.ndjson", "--out", "out"});
    const auto took = std::chrono::steady_clock::now() - start_of_fresh;
    longest_pause = std::max<std::chrono::microseconds>(
        std::chrono::milliseconds(16), std::chrono::duration_cast<std::chrono::microseconds>(took / 10));
    ASSERT_EQ(fresh.code, 0) << "round " << round << ": " << fresh.output;
    ASSERT_EQ(read("out/all.txt"), truth) << "round " << round;
    for (const std::string& task : tasks_told("fresh.ndjson", "finished"))
      ASSERT_FALSE(finished.contains(task)) << "round " << round << ": " << task << " was finished, and ran again";
  }
  EXPECT_GT(killed_early, static_cast<std::size_t>(rounds));
  EXPECT_GT(reported, static_cast<std::size_t>(rounds));
  std::printf("%d rounds, %zu of %d processes killed at work, %zu tasks told finished, none lost\n", rounds,
              killed_early, rounds * processes, reported);
  EXPECT_EQ(command({"cache", "verify"}).code, 0);
}

TEST_F(SharedStore, ComputesOnceWhatEightProcessesAskFor) {
  write_frames(4);
  write("graph.json", R"({"facegraph": 1, "params": {"folder": {"type": "path", "default": "frames"}},
"nodes": {"files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"slow": {"node": "toy.sleep", "inputs": {"text": "texts"}, "params": {"seconds": 0.5}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "slow"}}},
"outputs": {"all.txt": "all"}})");
  std::vector<pid_t> children;
  for (int p = 0; p < processes; ++p)
    children.push_back(start({"run", "graph.json", "--quiet", "--out", "out" + std::to_string(p), "--summary",
                              "summary" + std::to_string(p) + ".json"}));
  std::size_t ran = 0;
  for (int p = 0; p < processes; ++p) {
    const test::Ended ended = wait(children[static_cast<std::size_t>(p)]);
    ASSERT_EQ(ended.code, 0) << ended.output;
    ran += tasks_run("summary" + std::to_string(p) + ".json");
    EXPECT_EQ(read("out" + std::to_string(p) + "/all.txt"), "frame 1\nframe 2\nframe 3\nframe 4");
  }
  EXPECT_EQ(ran, 9u);
}

TEST_F(SharedStore, NoticesAnInputThatChangesDuringTheRun) {
  write("frames/1.txt", std::string(100, 'a'));
  write("graph.json", R"({"facegraph": 1, "params": {"folder": {"type": "path", "default": "frames"}},
"nodes": {"files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.slow_read", "inputs": {"file": "files"}, "params": {"seconds": 0.6}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "texts"}}},
"outputs": {"all.txt": "all"}})");
  const pid_t child = start({"run", "graph.json", "--quiet", "--out", "out", "--events", "events.ndjson"});
  const auto patience = std::chrono::steady_clock::now() + 20s;
  while (tasks_told("events.ndjson", "started").empty() && std::chrono::steady_clock::now() < patience)
    std::this_thread::sleep_for(10ms);
  write("frames/1.txt", std::string(100, 'b'));
  const test::Ended ended = wait(child);
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.failures(), std::vector<std::string>{"texts[1] (toy.slow_read): file " + path("frames/1.txt") +
                                                       " changed while it was read: run again"});
  EXPECT_EQ(command({"run", "graph.json", "--quiet", "--out", "out"}).code, 0);
  EXPECT_EQ(read("out/all.txt"), std::string(100, 'b'));
}

TEST_F(SharedStore, FindsAFlippedByteAndComputesAnew) {
  write("frames/1.txt", std::string(20000, 'a'));
  const Words words = {"run", graph("toy/frames.json"), "--set", "folder=frames", "--quiet", "--out", "out"};
  ASSERT_EQ(command(words).code, 0);
  const std::string truth = read("out/all.txt");
  std::size_t flipped = 0;
  for (const char* part : {"store/objects", "store/files"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder() / part)) {
      if (!entry.is_regular_file()) continue;
      std::string bytes = test::read_file(entry.path());
      bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
      const auto time = std::filesystem::last_write_time(entry.path());
      std::filesystem::permissions(entry.path(), std::filesystem::perms::owner_write,
                                   std::filesystem::perm_options::add);
      std::ofstream(entry.path(), std::ios::binary) << bytes;
      std::filesystem::last_write_time(entry.path(), time);
      ++flipped;
    }
  ASSERT_GE(flipped, 2u);
  std::filesystem::remove_all(folder() / "out");
  const test::Ended ended = command(words);
  EXPECT_EQ(ended.code, 0) << ended.output;
  EXPECT_EQ(read("out/all.txt"), truth);
  EXPECT_NE(ended.output.find("was damaged"), std::string::npos) << ended.output;
  EXPECT_EQ(command(words).output, "");  // nothing is damaged any more
}

// Events and trace of one run, by the schema of docs/events.md.
TEST_F(SharedStore, TellsARunAsEventsAndAsATrace) {
  write_frames(5);
  write("frames/3.txt", "forbidden");
  const Words words = {"run",      graph("toy/frames.json"), "--set",   "folder=frames", "--quiet",
                       "--events", "events.ndjson",          "--trace", "trace.json"};
  EXPECT_EQ(command(words).code, 1);
  std::map<std::string, int> events;
  for (const std::string& line : test::lines_of(read("events.ndjson"))) {
    const nlohmann::json json = nlohmann::json::parse(line);
    const std::string event = json.at("event");
    ++events[event];
    for (const char* number : {"time_s", "done", "known"}) EXPECT_TRUE(json.at(number).is_number()) << line;
    for (const char* text : {"node", "type"}) EXPECT_TRUE(json.at(text).is_string()) << line;
    EXPECT_EQ(json.contains("seconds"), event == "finished" || event == "made") << line;
    EXPECT_EQ(json.contains("text"), event == "failed" || event == "warning") << line;
    if (event == "started" || event == "finished") {
      EXPECT_GE(json.at("worker").get<int>(), 1) << line;
    }
  }
  EXPECT_EQ(events, (std::map<std::string, int>{{"started", 15}, {"finished", 14}, {"failed", 1}, {"blocked", 1}}));

  const auto slices = [&] {
    std::map<std::string, int> fates;
    std::set<int> named;
    for (const nlohmann::json& json : nlohmann::json::parse(read("trace.json"))) {
      if (json.at("ph") == "M") {
        named.insert(json.at("tid").get<int>());
        continue;
      }
      EXPECT_EQ(json.at("ph"), "X");
      EXPECT_TRUE(named.contains(json.at("tid").get<int>()));
      EXPECT_GE(json.at("dur").get<double>(), 0);
      EXPECT_TRUE(json.at("args").at("node").is_string());
      EXPECT_TRUE(json.at("args").at("element").is_string());
      ++fates[json.at("args").at("fate").get<std::string>()];
    }
    return fates;
  };
  EXPECT_EQ(slices(), (std::map<std::string, int>{{"run", 14}, {"failed", 1}}));
  EXPECT_EQ(command(words).code, 1);
  EXPECT_EQ(slices(), (std::map<std::string, int>{{"reused", 14}, {"failed", 1}}));
}

TEST_F(SharedStore, AnAuditNamesANodeThatIsNotDeterministic) {
  write_frames(3);
  write("graph.json", R"({"facegraph": 1, "params": {"folder": {"type": "path", "default": "frames"}},
"nodes": {"files": {"node": "files.list", "inputs": {"folder": "${folder}"}},
"texts": {"node": "toy.read_text", "inputs": {"file": "files"}},
"odd": {"node": "toy.unsteady", "inputs": {"text": "texts"}},
"all": {"node": "toy.join_texts", "inputs": {"texts": "odd"}}},
"outputs": {"all.txt": "all"}})");
  const Words set = {"--set", "odd.unsteady=false"};
  ASSERT_EQ(command(Words{"run", "graph.json", "--quiet", "--out", "out"} + set).code, 0);
  test::Ended ended = command(Words{"cache", "audit", "graph.json", "--sample", "100%", "--seed", "5"} + set);
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.output, "7 of 7 stored tasks run again, 0 differ\n");
  ASSERT_EQ(command({"run", "graph.json", "--quiet", "--out", "out"}).code, 0);
  ended = command({"cache", "audit", "graph.json", "--sample", "100%"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.said("differs: odd[").size(), 3u) << ended.output;
  EXPECT_EQ(command({"cache", "audit", "graph.json", "--sample", "half"}).code, 2);
}

}  // namespace
