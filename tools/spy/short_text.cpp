#include "tools/spy/short_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace puck {
namespace {

template <typename... Values>
std::string format(const char* how, Values... values) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), how, values...);
  return text.data();
}

/// Three digits and the letter of a power of 1000, for 100 000 or more.
std::string with_letter(double number) {
  constexpr std::string_view kLetters = "kMGTPE";
  std::size_t letter = 0;
  number /= 1000;
  // Rounding to four digits would need the next letter.
  while (std::abs(number) >= 999.5 && letter + 1 < kLetters.size()) {
    number /= 1000;
    ++letter;
  }
  const double size = std::abs(number);
  const int decimals = size < 9.995 ? 2 : size < 99.95 ? 1 : 0;
  return format("%.*f%c", decimals, number, kLetters[letter]);
}

std::string cut(std::string_view text, std::size_t width) {
  std::string fitted = plain_text(text);
  if (fitted.size() <= width) return fitted;
  fitted.resize(width);
  if (width > 0) fitted.back() = '~';
  return fitted;
}

}  // namespace

std::string short_count(std::int64_t count) {
  constexpr std::int64_t kMostPlain = 99'999;
  if (count >= -kMostPlain && count <= kMostPlain) return std::to_string(count);
  return with_letter(static_cast<double>(count));
}

std::string short_rate(double per_second) {
  if (per_second < 99.95) return format("%.1f", per_second);
  if (per_second < 99'999.5) return format("%.0f", per_second);
  return with_letter(per_second);
}

std::string short_duration(std::int64_t duration_us) {
  const std::int64_t ms = duration_us / 1000;
  const std::int64_t s = ms / 1000;
  const std::int64_t minutes = s / 60;
  const std::int64_t hours = minutes / 60;
  const auto number = [](std::int64_t value) { return static_cast<long long>(value); };
  if (ms < 1000) return format("%lldms", number(ms));
  if (s < 100) return format("%lld.%llds", number(s), number(ms % 1000 / 100));
  if (minutes < 100) return format("%lldm%02llds", number(minutes), number(s % 60));
  if (hours < 100) return format("%lldh%02lldm", number(hours), number(minutes % 60));
  return format("%lldd", number(hours / 24));
}

std::string plain_text(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    // Continuation bytes of UTF-8.
    if ((byte & 0xc0) == 0x80) continue;
    plain += byte >= 0x20 && byte < 0x7f ? c : '?';
  }
  return plain;
}

std::string fit_left(std::string_view text, std::size_t width) {
  std::string fitted = cut(text, width);
  fitted.append(width - fitted.size(), ' ');
  return fitted;
}

std::string fit_right(std::string_view text, std::size_t width) {
  std::string fitted = cut(text, width);
  fitted.insert(0, width - fitted.size(), ' ');
  return fitted;
}

}  // namespace puck
