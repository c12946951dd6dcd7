#include "tools/doctor/report.h"

#include <algorithm>
#include <sstream>

#include <nlohmann/json.hpp>

namespace puck {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kIndent = 20;  // Of the text, after the columns of verdict and check.

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kNote:
      return "note";
    case Verdict::kWrong:
      return "WRONG";
  }
  return "";
}

std::string padded(std::string text, std::size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

/// Continues in the same column.
std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines;
  std::size_t column = kIndent;
  for (std::string word; words >> word;) {
    if (column > kIndent && column + 1 + word.size() > kWidth) {
      lines += "\n" + std::string(kIndent, ' ');
      column = kIndent;
    }
    if (column > kIndent) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines;
}

}  // namespace

int count(const Findings& findings, Verdict verdict) {
  return static_cast<int>(
      std::count_if(findings.begin(), findings.end(),
                    [&](const Finding& finding) { return finding.verdict == verdict; }));
}

std::string report_text(const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += padded(padded(to_string(finding.verdict), 6) + finding.check, kIndent) +
            wrapped(finding.text) + "\n";
    // In one line of any length, for copying.
    if (!finding.mend.empty()) {
      text += padded("", kIndent) + (finding.verdict == Verdict::kWrong ? "mend: " : "maybe: ") +
              finding.mend + "\n";
    }
  }
  const int wrong = count(findings, Verdict::kWrong);
  const int notes = count(findings, Verdict::kNote);
  text += wrong == 0 ? "nothing is wrong" : std::to_string(wrong) + " wrong";
  if (notes > 0) text += ", " + std::to_string(notes) + (notes == 1 ? " note" : " notes");
  return text + "\n";
}

std::string report_json(const Findings& findings) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Finding& finding : findings) {
    nlohmann::ordered_json entry{
        {"check", finding.check},
        {"verdict", finding.verdict == Verdict::kWrong ? "wrong" : to_string(finding.verdict)},
        {"text", finding.text},
        {"mend", nullptr}};
    if (!finding.mend.empty()) entry["mend"] = finding.mend;
    list.push_back(std::move(entry));
  }
  const nlohmann::ordered_json report{{"wrong", count(findings, Verdict::kWrong)},
                                      {"notes", count(findings, Verdict::kNote)},
                                      {"findings", std::move(list)}};
  // Text from the network may not be UTF-8.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace puck
