// SPDX-License-Identifier: Apache-2.0
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <regex>

#include "tests/conformance/node_samples.h"
#include "tests/conformance/odd_values.h"
#include "tests/conformance/rules.h"

namespace conformance {
namespace {

constexpr const char* start_variable = "FACEGRAPH_ODD_INPUT_FROM";  // number of the first odd input to try
constexpr unsigned most_s = 60;                                     // of processor time, for one
constexpr rlim_t most_memory = rlim_t{12} << 30;

// What a library says of itself, and not of what it was given.
bool names_nothing(const std::string& what) {
  static const std::regex library(
      "std::|basic_string|vector::|_M_|bad_alloc|Assertion|OpenCV\\(|map::at|stoi|stod|bad optional");
  return what.empty() || std::regex_search(what, library);
}

void say(const std::string& word, std::size_t number, const std::string& text) {
  std::printf("\n@%s %zu %s\n", word.c_str(), number, text.c_str());
  std::fflush(stdout);
}

struct Odd {
  std::string text;
  PortValues inputs;
};

// Each port in turn.
std::vector<Odd> odd_inputs(const engine::NodeDeclaration& node, const PortValues& inputs) {
  std::vector<Odd> all;
  for (std::size_t p = 0; p < inputs.size(); ++p) {
    const std::string port = node.info.inputs[p].name + ": ";
    for (const Oddity oddity : {Oddity::empty, Oddity::one_element, Oddity::not_a_number, Oddity::infinite}) {
      Odd odd{port + name_of(oddity), inputs};
      PortValue& changed = odd.inputs[p];
      bool differs = false;
      const auto replace = [&](AnyValue& value) {
        if (AnyValue other = odd_value(*node.input_types[p], value, oddity)) value = other, differs = true;
      };
      if (changed.value) replace(changed.value);
      for (AnyValue& element : changed.elements) replace(element);
      if (differs) all.push_back(odd);
    }
    if (node.info.inputs[p].depth == 0) continue;
    for (const std::size_t count : {0, 1}) {
      Odd odd{port + (count == 0 ? "no element in the sequence" : "one element in the sequence"), inputs};
      odd.inputs[p].elements.resize(count);
      all.push_back(odd);
    }
  }
  return all;
}

}  // namespace

bool asked_for_odd_input() { return std::getenv(start_variable) != nullptr; }

void try_odd_input(engine::Plugins& plugins, const std::string& node) {
  const engine::NodeDeclaration& declaration = plugins.load(node);
  PortValues inputs;
  try {
    for (std::size_t p = 0; p < declaration.info.inputs.size(); ++p) {
      const auto sample = port_sample(plugins, declaration, p, 0);
      if (!sample) return;  // told elsewhere
      inputs.push_back(*sample);
    }
  } catch (const std::exception&) {
    return;
  }
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const rlimit memory{most_memory, most_memory};
  ::setrlimit(RLIMIT_AS, &memory);
#endif
  const std::vector<Odd> all = odd_inputs(declaration, inputs);
  for (std::size_t i = static_cast<std::size_t>(std::atoi(std::getenv(start_variable))); i < all.size(); ++i) {
    say("try", i, all[i].text);
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    const auto until = static_cast<rlim_t>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) + most_s;
    const rlimit time{until, until + 5};
    ::setrlimit(RLIMIT_CPU, &time);
    const Outcome outcome = call_node(declaration, all[i].inputs, sample_params(declaration.info));
    if (outcome.no_exception)
      say("bad", i, "threw something without a text");
    else if (outcome.threw && names_nothing(outcome.what))
      say("bad", i, "the error does not name the input: " + outcome.what.substr(0, outcome.what.find('\n')));
  }
  say("end", all.size(), "");
}

Lines broken_by_odd_input(const std::string& filter) {
  const std::string node = filter.substr(filter.find('.') + 1);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  Lines lines;
  std::size_t from = 0;
  for (int crashes = 0; crashes < 8; ++crashes) {
    ::setenv(start_variable, std::to_string(from).c_str(), 1);
    FILE* output = ::popen(("exec '" + self + "' --gtest_color=no --gtest_filter='" + filter + "' 2>&1").c_str(), "r");
    ::unsetenv(start_variable);
    if (!output) return {node + ": odd input: cannot start " + self};
    std::string tried, tail;
    bool ended = false;
    char buffer[4096];
    while (std::fgets(buffer, sizeof buffer, output)) {
      const std::string line(buffer, std::strcspn(buffer, "\n"));
      if (line.rfind("@try ", 0) == 0) {
        from = static_cast<std::size_t>(std::atoi(line.c_str() + 5)) + 1;
        tried = line.substr(line.find(' ', 5) + 1);
      } else if (line.rfind("@bad ", 0) == 0) {
        lines.push_back(node + ": input " + tried +
                        ": a named error or a report: " + line.substr(line.find(' ', 5) + 1));
      } else if (line.rfind("@end ", 0) == 0) {
        ended = true;
      }
    }
    const int status = ::pclose(output);
    if (ended || tried.empty()) break;
    const std::string how = WIFSIGNALED(status) ? std::string("ended by signal ") + ::strsignal(WTERMSIG(status))
                                                : "left with exit code " + std::to_string(WEXITSTATUS(status));
    lines.push_back(node + ": input " + tried + ": never crashes: " + how);
  }
  return lines;
}

}  // namespace conformance
