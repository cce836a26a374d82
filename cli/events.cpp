// SPDX-License-Identifier: Apache-2.0
#include "cli/events.h"

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "engine/base/problem.h"

namespace cli {
namespace {

const char* name_of(engine::RunEvent::Kind kind) {
  using Kind = engine::RunEvent::Kind;
  switch (kind) {
    case Kind::started:
      return "started";
    case Kind::finished:
      return "finished";
    case Kind::made:
      return "made";
    case Kind::reused:
      return "reused";
    case Kind::failed:
      return "failed";
    case Kind::blocked:
      return "blocked";
    case Kind::warning:
      return "warning";
    case Kind::progress:
      return "progress";
  }
  return "";
}

std::FILE* open(const std::string& path) {
  std::FILE* file = std::fopen(path.c_str(), "we");
  if (!file) throw engine::EngineError("cannot write " + path + ": " + std::strerror(errno));
  return file;
}

}  // namespace

EventWriter::EventWriter(const std::string& path) {
  if (path == "-")
    file_ = stdout;
  else if (!path.empty())
    file_ = open(path);
  // Whoever follows the file, or reads it after a crash, sees whole lines.
  if (file_) std::setvbuf(file_, nullptr, _IOLBF, BUFSIZ);
}

EventWriter::~EventWriter() {
  if (file_ && file_ != stdout) std::fclose(file_);
}

void EventWriter::write(const engine::RunEvent& event) {
  if (!file_) return;
  nlohmann::ordered_json json = {{"event", name_of(event.kind)}, {"time_s", event.time_s}, {"node", event.node},
                                 {"type", event.type},           {"done", event.done},     {"known", event.known}};
  if (!event.element.empty()) json["element"] = event.element;
  if (!event.text.empty()) json["text"] = event.text;
  if (event.worker > 0) json["worker"] = event.worker;
  if (event.kind == engine::RunEvent::Kind::finished || event.kind == engine::RunEvent::Kind::made)
    json["seconds"] = event.seconds;
  if (event.kind == engine::RunEvent::Kind::progress) json["fraction"] = event.fraction;
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (std::fputs(text.c_str(), file_) < 0 && !failed_) {
    failed_ = true;
    std::fprintf(stderr, "warning: events cannot be written: %s\n", std::strerror(errno));
  }
}

void check_writable(const std::string& path) {
  if (std::FILE* file = std::fopen(path.c_str(), "ae"))
    std::fclose(file);
  else
    throw engine::EngineError("cannot write " + path + ": " + std::strerror(errno));
}

void write_summary(const std::string& path, const engine::RunResult& result) {
  const nlohmann::ordered_json json = {{"tasks",
                                        {{"run", result.tasks.run},
                                         {"reused", result.tasks.reused},
                                         {"failed", result.tasks.failed},
                                         {"blocked", result.tasks.blocked}}},
                                       {"seconds", result.seconds},
                                       {"failures", result.failures},
                                       {"published", result.published}};
  std::FILE* file = open(path);
  const std::string text = json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  const bool written = std::fputs(text.c_str(), file) >= 0;
  if (std::fclose(file) != 0 || !written)
    throw engine::EngineError("cannot write " + path + ": " + std::strerror(errno));
}

}  // namespace cli
