// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/commands.h"
#include "cli/curves.h"
#include "cli/differences.h"
#include "cli/experiments.h"

namespace cli {

using Json = nlohmann::ordered_json;

namespace {

// "; most at [67]: largest 0.72, rms 0.02"
std::string measures_of(const Json& d) {
  if (!d.contains("measures")) return {};
  std::string text = d.contains("most_at") ? "; most at [" + d["most_at"].get<std::string>() + "]: " : "; ";
  constexpr std::size_t most_told = 5;  // the page and --json have all
  std::size_t told = 0;
  for (const auto& [name, value] : d["measures"].items()) {
    if (told++ == most_told) {
      text += ", ...";
      break;
    }
    text +=
        (told == 1 ? "" : ", ") + name + " " + (value.is_number() ? short_number(value.get<double>()) : value.dump());
  }
  return text;
}

}  // namespace

std::string line_of(const Json& d) {
  const auto count = [&](const char* key) { return d.value(key, std::size_t{0}); };
  std::string text;
  if (d.contains("a"))
    text += shortened(d["a"].dump()) + " -> " + shortened(d["b"].dump());
  else if (d.contains("values") && (count("values") != 1 || count("differing") != 1))
    text += std::to_string(count("differing")) + " of " + std::to_string(count("values")) + " values differ";
  else
    text += "differs";
  if (count("only_in_a") > 0) text += ", " + std::to_string(count("only_in_a")) + " only in A";
  if (count("only_in_b") > 0) text += ", " + std::to_string(count("only_in_b")) + " only in B";
  text += measures_of(d);
  if (d.contains("parts"))
    for (const auto& [what, part] : d["parts"].items())
      text += "; " + what +
              (part.contains("not_compared") ? " not compared: " + part["not_compared"].get<std::string>()
                                             : measures_of(part));
  if (d.contains("largest_difference")) {
    const std::string at = d["largest_at"];
    text += "; by at most " + short_number(d["largest_difference"]) + (at.empty() ? "" : " at " + at);
    if (!d.contains("a")) text += ", rms " + short_number(d["rms_difference"]);
  }
  if (d.contains("form_differs")) text += "; they are not made alike";
  if (d.contains("lines_differing"))
    text += "; " + std::to_string(count("lines_differing")) + " of " + std::to_string(count("lines")) +
            " lines, the first is line " + std::to_string(count("first_line"));
  if (d.contains("bytes_a") && !d.contains("measures") && !d.contains("parts") && !d.contains("largest_difference") &&
      !d.contains("lines_differing"))
    text +=
        "; " + show_size(d["bytes_a"].get<std::uint64_t>()) + " and " + show_size(d["bytes_b"].get<std::uint64_t>());
  if (d.contains("not_compared")) text += "; not compared: " + d["not_compared"].get<std::string>();
  return text;
}

}  // namespace cli
