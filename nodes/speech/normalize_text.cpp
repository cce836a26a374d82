// SPDX-License-Identifier: Apache-2.0
#include "nodes/speech/normalize_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "nodes/base/check.h"

namespace face::speech {
namespace {

using Words = std::vector<std::string>;

constexpr std::array<std::string_view, 20> small_numbers = {
    "zero", "one",    "two",    "three",    "four",     "five",    "six",     "seven",     "eight",    "nine",
    "ten",  "eleven", "twelve", "thirteen", "fourteen", "fifteen", "sixteen", "seventeen", "eighteen", "nineteen"};
constexpr std::array<std::string_view, 10> tens = {"",      "",      "twenty",  "thirty", "forty",
                                                   "fifty", "sixty", "seventy", "eighty", "ninety"};
constexpr std::array<std::pair<std::string_view, std::string_view>, 12> irregular_ordinals = {{{"one", "first"},
                                                                                               {"two", "second"},
                                                                                               {"three", "third"},
                                                                                               {"five", "fifth"},
                                                                                               {"eight", "eighth"},
                                                                                               {"nine", "ninth"},
                                                                                               {"twelve", "twelfth"},
                                                                                               {"twenty", "twentieth"},
                                                                                               {"thirty", "thirtieth"},
                                                                                               {"forty", "fortieth"},
                                                                                               {"fifty", "fiftieth"},
                                                                                               {"sixty", "sixtieth"}}};
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> titles = {{{"mr", "mister"},
                                                                                  {"mrs", "missus"},
                                                                                  {"ms", "miz"},
                                                                                  {"dr", "doctor"},
                                                                                  {"prof", "professor"},
                                                                                  {"vs", "versus"},
                                                                                  {"jr", "junior"},
                                                                                  {"sr", "senior"},
                                                                                  {"etc", "et cetera"}}};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
char lower(char c) { return is_upper(c) ? static_cast<char>(c - 'A' + 'a') : c; }

// The ASCII spelling of a code point: accents go, quotes and dashes become plain ones; null where there is none.
const char* plain(unsigned code) {
  if (code >= 0xC0 && code <= 0x17F) {
    static constexpr std::string_view latin =  // U+00C0 to U+00FF
        "AAAAAA_CEEEEIIIIDNOOOOO OUUUUY__aaaaaa_ceeeeiiiidnooooo ouuuuy_y";
    static constexpr std::array<std::string_view, 26> single = {"a", "b", "c", "d", "e", "f", "g", "h", "i",
                                                                "j", "k", "l", "m", "n", "o", "p", "q", "r",
                                                                "s", "t", "u", "v", "w", "x", "y", "z"};
    switch (code) {
      case 0xC6:
      case 0xE6:
        return "ae";
      case 0xDF:
        return "ss";
      case 0xDE:
      case 0xFE:
        return "th";
      case 0x152:
      case 0x153:
        return "oe";
      case 0x160:
      case 0x161:
        return "s";
      case 0x17D:
      case 0x17E:
        return "z";
      case 0x141:
      case 0x142:
        return "l";
      case 0x107:
      case 0x10D:
        return "c";
      default:
        break;
    }
    if (code > 0xFF) return nullptr;
    const char c = lower(latin[code - 0xC0]);
    return c >= 'a' && c <= 'z' ? single[static_cast<std::size_t>(c - 'a')].data() : nullptr;
  }
  switch (code) {
    case 0x2018:
    case 0x2019:
    case 0x02BC:
    case 0x2032:
      return "'";
    case 0x201C:
    case 0x201D:
    case 0x00AB:
    case 0x00BB:
    case 0x201E:
      return "\"";
    case 0x2010:
    case 0x2011:
    case 0x2012:
    case 0x2013:
    case 0x2014:
    case 0x2015:
      return "-";
    case 0x2026:
      return "... ";
    case 0x00A0:
    case 0x2009:
    case 0x202F:
    case 0xFEFF:
    case 0x200B:
      return " ";
    case 0x00A3:
      return " pounds ";
    case 0x20AC:
      return " euros ";
    case 0x00B0:
      return " degrees ";
    default:
      return nullptr;
  }
}

void append(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

Words digits_one_by_one(std::string_view digits) {
  Words words;
  for (const char c : digits) words.emplace_back(small_numbers[static_cast<std::size_t>(c - '0')]);
  return words;
}

Words whole_number(const std::string& digits) {
  if (digits.size() > 15 || (digits.size() > 1 && digits[0] == '0')) return digits_one_by_one(digits);
  return number_words(std::stoll(digits));
}

Words year_words(int year) {
  Words words = number_words(year / 100);
  if (year % 100 == 0) {
    words.emplace_back("hundred");
  } else {
    if (year % 100 < 10) words.emplace_back("oh");
    append(words, number_words(year % 100));
  }
  return words;
}

void make_ordinal(Words& words) {
  std::string& last = words.back();
  for (const auto& [cardinal, ordinal] : irregular_ordinals)
    if (last == cardinal) {
      last = ordinal;
      return;
    }
  if (last.ends_with("y")) {
    last.pop_back();
    last += "ieth";
  } else {
    last += "th";
  }
}

// Reads a number at text[i], which is a digit, with what belongs to it; moves i behind it.
Words read_number(std::string_view text, std::size_t& i, bool money) {
  std::string digits;
  bool grouped = false;
  const auto digit_at = [&](std::size_t k) { return k < text.size() && is_digit(text[k]); };
  while (i < text.size()) {
    if (is_digit(text[i])) {
      digits += text[i++];
    } else if (text[i] == ',' && digit_at(i + 1) && digit_at(i + 2) && digit_at(i + 3) && !digit_at(i + 4)) {
      grouped = true;
      ++i;
    } else {
      break;
    }
  }
  const auto take_digits = [&] {
    std::string more;
    while (digit_at(i)) more += text[i++];
    return more;
  };
  Words words = whole_number(digits);
  if (i < text.size() && text[i] == ':' && digit_at(i + 1)) {  // a time
    ++i;
    const std::string minutes = take_digits();
    if (minutes == "00") return words.emplace_back("o'clock"), words;
    if (minutes[0] == '0' && minutes.size() > 1) words.emplace_back("oh");
    append(words, number_words(std::stoll(minutes.substr(0, 15))));
    return words;
  }
  if (i < text.size() && text[i] == '.' && digit_at(i + 1)) {
    ++i;
    const std::string decimals = take_digits();
    if (money && decimals.size() == 2) {
      words.emplace_back(digits == "1" ? "dollar" : "dollars");
      if (decimals != "00") append(words, number_words(std::stoll(decimals)));
    } else {
      words.emplace_back("point");
      append(words, digits_one_by_one(decimals));
    }
    return words;
  }
  if (i + 1 < text.size()) {
    const std::string ending = {lower(text[i]), lower(text[i + 1])};
    if ((ending == "st" || ending == "nd" || ending == "rd" || ending == "th") &&
        (i + 2 >= text.size() || !is_letter(text[i + 2]))) {
      i += 2;
      make_ordinal(words);
      return words;
    }
  }
  if (money) return words.emplace_back(digits == "1" ? "dollar" : "dollars"), words;
  if (!grouped && digits.size() == 4 && digits >= "1100" && digits <= "1999") return year_words(std::stoi(digits));
  return words;
}

void add_word(const std::string& token, bool period_follows, Words& words) {
  std::string word;
  for (const char c : token) word += lower(c);
  while (!word.empty() && word.back() == '\'') word.pop_back();
  while (!word.empty() && word.front() == '\'' && word != "'em" && word != "'til" && word != "'tis" && word != "'twas")
    word.erase(0, 1);
  if (word.empty()) return;
  for (const auto& [title, spoken] : titles)
    if (word == title && (period_follows || is_upper(token[0]))) {
      const std::size_t blank = spoken.find(' ');
      words.emplace_back(spoken.substr(0, blank));
      if (blank != std::string_view::npos) words.emplace_back(spoken.substr(blank + 1));
      return;
    }
  const bool capitals = token.size() >= 2 && token.size() <= 5 && std::all_of(token.begin(), token.end(), is_upper);
  if (capitals && word.find_first_of("aeiouy") == std::string::npos) {
    for (const char c : word) words.emplace_back(1, c);
    return;
  }
  words.push_back(std::move(word));
}

const char* symbol_word(char c) {
  switch (c) {
    case '&':
      return "and";
    case '+':
      return "plus";
    case '%':
      return "percent";
    case '@':
      return "at";
    case '=':
      return "equals";
    default:
      return nullptr;
  }
}

}  // namespace

std::string ascii_text(std::string_view text, std::vector<std::string>& warnings) {
  constexpr std::size_t most_named = 20;
  std::string ascii, dropped;
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = byte < 0x80 ? 1 : byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC0 ? 2 : 1;
    if (length == 1) {
      ascii += byte < 0x80 ? text[i] : ' ';
      ++i;
      continue;
    }
    unsigned code = byte & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length && i + k < text.size(); ++k)
      code = code << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3FU);
    if (const char* spelling = plain(code)) {
      ascii += spelling;
    } else {
      ascii += ' ';
      if (count++ < most_named) dropped += text.substr(i, length);
    }
    i += length;
  }
  if (count > 0)
    warnings.push_back(message("left out ", count, count == 1 ? " character" : " characters",
                               " that cannot be read as English: ", dropped, count > most_named ? " ..." : ""));
  return ascii;
}

std::vector<std::string> number_words(long long number) {
  check(number >= 0 && number < 1'000'000'000'000'000, "number_words(", number, "): expected 0 to 10^15 - 1");
  if (number < 20) return {std::string(small_numbers[static_cast<std::size_t>(number)])};
  Words words;
  constexpr std::array<std::pair<long long, std::string_view>, 5> units = {{{1'000'000'000'000, "trillion"},
                                                                            {1'000'000'000, "billion"},
                                                                            {1'000'000, "million"},
                                                                            {1000, "thousand"},
                                                                            {100, "hundred"}}};
  for (const auto& [unit, name] : units) {
    if (number < unit) continue;
    append(words, number_words(number / unit));
    words.emplace_back(name);
    number %= unit;
  }
  if (number >= 20) {
    words.emplace_back(tens[static_cast<std::size_t>(number / 10)]);
    number %= 10;
  }
  if (number > 0) words.emplace_back(small_numbers[static_cast<std::size_t>(number)]);
  return words;
}

NormalizedText normalize_text(std::string_view text) {
  NormalizedText result;
  const std::string ascii = ascii_text(text, result.warnings);
  bool money = false;
  for (std::size_t i = 0; i < ascii.size();) {
    const char c = ascii[i];
    if (is_digit(c)) {
      append(result.words, read_number(ascii, i, money));
      money = false;
    } else if (is_letter(c) || c == '\'') {
      const std::size_t start = i;
      while (i < ascii.size() && (is_letter(ascii[i]) || ascii[i] == '\'')) ++i;
      add_word(ascii.substr(start, i - start), i < ascii.size() && ascii[i] == '.', result.words);
    } else {
      if (const char* word = symbol_word(c)) result.words.emplace_back(word);
      money = c == '$';
      ++i;
    }
  }
  return result;
}

}  // namespace face::speech
