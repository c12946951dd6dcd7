#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/yarp/board_answer.h"
#include "common/yarp/name_server.h"
#include "common/yarp/text_lines.h"
#include "common/yarp/yarp_error.h"
#include "tests/yarp/wire_bytes.h"

namespace puck {
namespace {

const std::string kEnd = " [tsta] 0 1795247365.76 [ok]";

BoardAnswer answer(const std::string& line) { return {"get it", line}; }

}  // namespace

TEST_CASE("lines are extracted from bytes in any division") {
  const std::string text = "Welcome puck\r\n[ok]\n\r\nrest";
  for (const std::size_t piece : {1, 3, 100}) {
    TextLines reader;
    std::vector<std::string> lines;
    for (std::size_t at = 0; at < text.size(); at += piece) {
      reader.feed(wire(text.substr(at, piece)));
      while (const auto line = reader.next()) lines.push_back(*line);
    }
    CHECK(lines == std::vector<std::string>{"Welcome puck", "[ok]", ""});
  }
}

TEST_CASE("a line without an end, or with bytes that are not text, is refused early") {
  TextLines reader;
  reader.feed(wire(std::string(TextLines::kMostBytes, 'x')));
  CHECK(!reader.next());
  reader.feed(wire("x"));
  CHECK_THROWS_WITH_AS(reader.next(), "it sent a line without an end", YarpError);
  for (const std::string& text :
       {std::string("a\0b", 3), std::string("\x1b[31m"), std::string("YA\x1")}) {
    TextLines other;
    other.feed(wire(text));
    CHECK_THROWS_AS(other.next(), YarpError);
  }
}

TEST_CASE("answers of a real board are parsed") {
  CHECK(answer("[is] axes 7" + kEnd).count("axes", 64) == 7);
  CHECK(answer("[is] name joint0" + kEnd).name("name") == "joint0");
  CHECK(answer("[is] name \"r shoulder (1)\"" + kEnd).name("name") == "r shoulder (1)");
  CHECK(answer("[is] llim 0.0 100.0" + kEnd).numbers("llim", 2) == std::vector<double>{0, 100});
  CHECK(answer("[is] encs (0.0 -1.5e-05 ) " + kEnd).numbers("encs", 2) ==
        std::vector<double>{0, -1.5e-05});
  CHECK(answer("[is] [cmds] ([pos] [posd])" + kEnd).vocabs("cmds", 2) ==
        std::vector<std::string>{"pos", "posd"});
  CHECK_NOTHROW(answer("[ok]"));
}

TEST_CASE("a refusal names the request") {
  CHECK_THROWS_WITH_AS(BoardAnswer("get llim 9", "[fail]"), "it refused \"get llim 9\" with [fail]",
                       YarpError);
  CHECK_THROWS_WITH_AS(BoardAnswer("get llim 9", "[is] llim [tsta] 0 0 [nak]"),
                       "it refused \"get llim 9\" with [nak]", YarpError);
}

TEST_CASE("an invalid answer, or one to another question, is refused") {
  for (const std::string& line :
       {std::string(), std::string("7"), std::string("[is] axes 7"), std::string("ok"),
        std::string("[is] axes 7 (ok)"), std::string("(([ok]"), std::string("[is] ((1)) [ok]"),
        std::string(") [ok]"), std::string("[ok"), std::string("\"x [ok]"),
        std::string("] [ok]")}) {
    CAPTURE(line);
    CHECK_THROWS_AS(answer(line), YarpError);
  }
  CHECK_THROWS_WITH_AS(answer("[is] axs 7" + kEnd).count("axes", 64),
                       ("it answered \"[is] axs 7" + kEnd + "\" to \"get it\"").c_str(), YarpError);
  for (const char* value : {"0", "-1", "65", "7.5", "x", "7 8", "", "99999999999", "()", "(7 8)"}) {
    CAPTURE(value);
    CHECK_THROWS_AS(answer("[is] axes " + std::string(value) + kEnd).count("axes", 64), YarpError);
  }
  for (const char* value : {"1", "1 2 3", "1 nan", "inf 2", "1 x", "(1 [x])"}) {
    CAPTURE(value);
    CHECK_THROWS_AS(answer("[is] llim " + std::string(value) + kEnd).numbers("llim", 2), YarpError);
  }
  CHECK_THROWS_AS(answer("[is] [cmds] ([pos])" + kEnd).vocabs("cmds", 2), YarpError);
  CHECK_THROWS_AS(answer("[is] [cmds] (pos pos)" + kEnd).vocabs("cmds", 2), YarpError);
}

TEST_CASE("the name server's registration of a port is parsed") {
  const PortAddress address =
      parse_registration("registration name /icub/right_arm/rpc:i ip 192.0.2.2 port 10002 type tcp",
                         "/icub/right_arm/rpc:i");
  CHECK(address.to_string() == "192.0.2.2:10002");
}

TEST_CASE("a registration of another port or without an address is refused") {
  for (const char* line :
       {"", "registration", "registration name /b ip 1.2.3.4 port 5 type tcp",
        "registration name /a ip 1.2.3.4 port 5 type tcp more",
        "registration name /a ip 1.2.3.4 port 0 type tcp",
        "registration name /a ip 1.2.3.4 port 65536 type tcp",
        "registration name /a ip 1.2.3.4 port -5 type tcp",
        "registration name /a ip 1.2.3.4 port 5x type tcp",
        "registration name /a ip 1.2.3 port 5 type tcp",
        "registration name /a ip any port 5 type tcp",
        "registration name /a ip 1.2.3.4 port 5 type udp",
        "registration name /a port 5 ip 1.2.3.4 type tcp", "*** end of message"}) {
    CAPTURE(line);
    CHECK_THROWS_AS(parse_registration(line, "/a"), YarpError);
  }
}

TEST_CASE("a board's text cannot control a terminal through an error message") {
  CHECK(in_quotes("a\x1b[31m\n\xff") == "\"a?[31m??\"");
  CHECK(in_quotes(std::string(100, 'x')).size() < 90);
}

}  // namespace puck
