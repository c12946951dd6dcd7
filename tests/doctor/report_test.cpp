#include "tools/doctor/report.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace puck {
namespace {

const Findings kFindings{{Verdict::kOk, "route", "goes by eth0"},
                         {Verdict::kNote, "ttl", "this host only", "--lcm-url x"},
                         {Verdict::kWrong, "mtu", "too \xff large", "puck-camera --set a=1"}};

}  // namespace

TEST_CASE("a report is a column of findings, each command on a line of its own") {
  CHECK(report_text(kFindings) ==
        "ok    route         goes by eth0\n"
        "note  ttl           this host only\n"
        "                    maybe: --lcm-url x\n"
        "WRONG mtu           too \xff large\n"
        "                    mend: puck-camera --set a=1\n"
        "1 wrong, 1 note\n");
  CHECK(report_text({{Verdict::kOk, "route", "goes by eth0"}}) ==
        "ok    route         goes by eth0\nnothing is wrong\n");
}

TEST_CASE("long text is wrapped, long commands are not") {
  std::string text = "word";
  for (int i = 0; i < 40; ++i) text += " word";
  const std::string report = report_text({{Verdict::kOk, "route", text}});
  std::size_t begin = 0;
  for (std::size_t end; (end = report.find('\n', begin)) != std::string::npos; begin = end + 1) {
    CHECK(end - begin <= 100);
  }
  const std::string command(300, 'x');
  CHECK(report_text({{Verdict::kWrong, "route", "a", command}}).find(command) != std::string::npos);
}

TEST_CASE("JSON has every finding, and stays valid with bytes that are not text") {
  const auto report = nlohmann::json::parse(report_json(kFindings));
  CHECK(report["wrong"] == 1);
  CHECK(report["notes"] == 1);
  REQUIRE(report["findings"].size() == 3);
  CHECK(report["findings"][0]["verdict"] == "ok");
  CHECK(report["findings"][0]["mend"].is_null());
  CHECK(report["findings"][2]["verdict"] == "wrong");
  CHECK(report["findings"][2]["check"] == "mtu");
  CHECK(report["findings"][2]["mend"] == "puck-camera --set a=1");
}

}  // namespace puck
