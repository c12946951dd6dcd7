#include "tools/doctor/settings.h"

#include <doctest/doctest.h>

#include "common/io/config.h"
#include "common/messaging/bus_error.h"
#include "tests/support/temporary_folder.h"

namespace puck {

TEST_CASE("the file of any service is accepted, and later settings win") {
  const TemporaryFolder folder;
  const auto file = folder.write("camera.toml",
                                 "[lcm]\nurl = \"udpm://239.1.1.1:1234?ttl=1\"\nprefix = \"LEFT\"\n"
                                 "[camera]\npacket_bytes = 1000\nsource = \"simulated\"\n");
  DoctorOptions options;
  options.config_file = file;
  options.seconds = 3;
  DoctorSettings settings = read_doctor_settings(options);
  CHECK(settings.url.port == 1234);
  CHECK(settings.prefix == "LEFT");
  CHECK(settings.packet_bytes == 1000);
  CHECK(settings.seconds == 3);

  options.settings = {"camera.packet_bytes=600", "lcm.prefix=RIGHT"};
  options.prefix = "MIDDLE";
  settings = read_doctor_settings(options);
  CHECK(settings.packet_bytes == 600);
  CHECK(settings.prefix == "MIDDLE");
}

TEST_CASE("the packet size defaults to the camera's") {
  DoctorOptions options;
  CHECK(read_doctor_settings(options).packet_bytes == 60000);
  options.lcm_url = "udpm://?ttl=1";
  CHECK(read_doctor_settings(options).packet_bytes == 1472);
}

TEST_CASE("impossible settings are refused") {
  DoctorOptions options;
  options.lcm_url = "memq://";
  CHECK_THROWS_AS(read_doctor_settings(options), BusError);
  options.lcm_url = "http://example.org";
  CHECK_THROWS_AS(read_doctor_settings(options), BusError);
  options.lcm_url.reset();
  options.prefix = "lower";
  CHECK_THROWS_AS(read_doctor_settings(options), BusError);
  options.prefix.reset();
  options.settings = {"camera.packet_byte=600"};
  CHECK_THROWS_AS(read_doctor_settings(options), ConfigError);
}

}  // namespace puck
