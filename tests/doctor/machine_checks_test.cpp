// Findings on a machine, from invented facts.
#include "tests/doctor/doctor_bench.h"

namespace puck {
namespace {

NetworkInterface& eth0(Facts& facts) { return facts.interfaces[1]; }

/// Everything goes over lo.
Facts loopback_facts() {
  Facts facts = healthy_facts();
  facts.route = KernelRoute{"lo", "127.0.0.1"};
  return facts;
}

}  // namespace

TEST_CASE("on a healthy machine every check passes") {
  const Findings findings = examine(healthy_facts());
  CHECK(findings.size() == 16);
  CHECK(count_of(findings, Verdict::kWrong) == 0);
  CHECK(count_of(findings, Verdict::kNote) == 1);  // No service publishes.
}

TEST_CASE("for a missing route to the group a route over an active interface is suggested") {
  Facts facts = healthy_facts();
  facts.route = "Network is unreachable";
  facts.interfaces.insert(facts.interfaces.begin(), {.name = "wlan0", .can_multicast = true});
  const Finding wrong = the_wrong_one(check_route(facts));
  CHECK(says(wrong, "Network is unreachable"));
  CHECK(wrong.mend == "ip route replace 224.0.0.0/4 dev eth0");
  facts.is_root = false;
  CHECK(the_wrong_one(check_route(facts)).mend == "sudo ip route replace 224.0.0.0/4 dev eth0");
  // Dependent checks do not fail as well.
  for (const auto check : {check_interface, check_mtu, check_membership, check_self_test}) {
    CHECK(count_of(check(facts), Verdict::kWrong) == 0);
  }
}

TEST_CASE("an inactive interface is activated before the route") {
  Facts facts = healthy_facts();
  facts.route = "Network is unreachable";
  eth0(facts).is_up = false;
  CHECK(the_wrong_one(check_route(facts)).mend ==
        "ip link set eth0 up && ip route replace 224.0.0.0/4 dev eth0");
  facts.is_root = false;
  CHECK(the_wrong_one(check_route(facts)).mend ==
        "sudo ip link set eth0 up && sudo ip route replace 224.0.0.0/4 dev eth0");
}

TEST_CASE("the loopback suffices for a single host") {
  Facts facts = healthy_facts();
  facts.url.ttl = 0;
  facts.route = "Network is unreachable";
  facts.interfaces.pop_back();
  CHECK(the_wrong_one(check_route(facts)).mend ==
        "ip link set lo up && ip route replace 224.0.0.0/4 dev lo");
}

TEST_CASE("a route over lo is right for ttl 0 and wrong for more") {
  Facts facts = loopback_facts();
  CHECK(the_wrong_one(check_route(facts)).mend == "ip route replace 224.0.0.0/4 dev eth0");
  facts.interfaces.pop_back();
  CHECK(the_wrong_one(check_route(facts)).mend ==
        "--lcm-url \"udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304\"");
  facts.url.ttl = 0;
  CHECK(count_of(check_route(facts), Verdict::kWrong) == 0);
}

TEST_CASE("an interface must be up, do multicast, have a link and an address") {
  Facts down = healthy_facts();
  eth0(down).is_up = false;
  CHECK(the_wrong_one(check_interface(down)).mend == "ip link set eth0 up");
  Facts no_multicast = healthy_facts();
  eth0(no_multicast).can_multicast = false;
  CHECK(the_wrong_one(check_interface(no_multicast)).mend == "ip link set eth0 multicast on");
  Facts no_link = healthy_facts();
  eth0(no_link).has_link = false;
  CHECK(says(the_wrong_one(check_interface(no_link)), "no cable"));
  Facts no_address = healthy_facts();
  eth0(no_address).addresses.clear();
  CHECK(says(the_wrong_one(check_interface(no_address)), "no IPv4 address"));
  // lo has no multicast flag and needs none.
  CHECK(count_of(check_interface(loopback_facts()), Verdict::kOk) == 1);
}

TEST_CASE("packets of exactly the frame size fit, a byte more is fragmented") {
  Facts facts = healthy_facts();
  CHECK(count_of(check_mtu(facts), Verdict::kOk) == 1);
  facts.packet_bytes = 1473;
  const Finding wrong = the_wrong_one(check_mtu(facts));
  CHECK(wrong.mend == "puck-camera --set camera.packet_bytes=1472");
  facts.url.ttl = 0;
  CHECK(count_of(check_mtu(facts), Verdict::kNote) == 1);
}

TEST_CASE("a frame too small for any packet must be enlarged") {
  Facts facts = healthy_facts();
  eth0(facts).mtu_bytes = 200;
  CHECK(the_wrong_one(check_mtu(facts)).mend == "ip link set eth0 mtu 1500");
}

TEST_CASE("large datagrams of another host are reported, those of this one are ignored") {
  Facts facts = healthy_facts();
  hear(facts.traffic, {"10.0.0.2", 5}, std::vector<std::uint8_t>(8000));
  CHECK(count_of(check_mtu(facts), Verdict::kWrong) == 0);
  hear(facts.traffic, {"10.0.0.9", 5}, std::vector<std::uint8_t>(8000));
  CHECK(says(the_wrong_one(check_mtu(facts)), "10.0.0.9 sends datagrams of 8000 bytes"));
}

TEST_CASE("a receive buffer reduced by the kernel is an error, a default one a note") {
  Facts facts = healthy_facts();
  facts.buffer_bytes = 212992;
  facts.rmem_max_bytes = 212992;
  const Finding wrong = the_wrong_one(check_buffer(facts));
  CHECK(says(wrong, "net.core.rmem_max=212992"));
  CHECK(wrong.mend == "sysctl -w net.core.rmem_max=4194304");
  facts.url.recv_buf_size.reset();
  CHECK(count_of(check_buffer(facts), Verdict::kNote) == 1);
}

TEST_CASE("a listener at the port outside the group receives nothing") {
  Facts facts = healthy_facts();
  facts.sockets_at_port = 2;
  facts.port_users = {{{"lcm-logger", 41}, 1}, {{"lcm-spy", 42}, 1}};
  facts.memberships = {{"eth0", "224.0.0.1", 5}};
  const Finding deaf = the_wrong_one(check_membership(facts));
  CHECK(says(deaf, "lcm-logger (pid 41), lcm-spy (pid 42)"));
  CHECK(deaf.mend == "kill 41 42");

  facts.memberships.push_back({"eth0", "239.255.76.67", 1});
  CHECK(count_of(check_membership(facts), Verdict::kNote) == 1);
  facts.memberships.back().users = 2;
  CHECK(count_of(check_membership(facts), Verdict::kOk) == 1);
  facts.memberships.back().interface = "wlan0";
  CHECK(says(the_wrong_one(check_membership(facts)), "others on wlan0"));
}

TEST_CASE("the self-test passes only if everything returns") {
  Facts facts = healthy_facts();
  facts.self_test.came_back = 19;
  CHECK(says(the_wrong_one(check_self_test(facts)), "19 of 20"));
  facts.self_test.came_back = 0;
  CHECK(says(the_wrong_one(check_self_test(facts)), "0 of 20"));
  facts.self_test = {.problem = "port 7667 cannot be shared (Address already in use)"};
  facts.port_users = {{{"greedy", 77}, 1}};
  CHECK(the_wrong_one(check_self_test(facts)).mend == "kill 77");
}

TEST_CASE("packet filter rules are an error if the self-test fails, else a note") {
  Facts facts = healthy_facts();
  CHECK(count_of(check_firewall(facts), Verdict::kOk) == 1);
  facts.firewall->push_back({"inet filter input", "policy drop", "nft insert rule a"});
  facts.firewall->push_back({"inet filter input", "udp drop", "nft insert rule a"});
  facts.firewall->push_back({"ip filter OUTPUT", "udp drop", "nft insert rule b"});
  CHECK(count_of(check_firewall(facts), Verdict::kNote) == 1);
  facts.self_test.came_back = 0;
  CHECK(the_wrong_one(check_firewall(facts)).mend == "nft insert rule a && nft insert rule b");
  facts.firewall.reset();
  CHECK(count_of(check_firewall(facts), Verdict::kNote) == 1);
}

TEST_CASE("a growing loss counter is an error, a constant one a note") {
  for (const auto counter : {&KernelCounters::reassembly_failures,
                             &KernelCounters::buffer_overflows, &KernelCounters::checksum_errors}) {
    Facts facts = healthy_facts();
    facts.before.value().*counter = 3;
    facts.after.value().*counter = 3;
    CHECK(count_of(check_counters(facts), Verdict::kNote) == 1);
    facts.after.value().*counter = 10;
    const Finding wrong = the_wrong_one(check_counters(facts));
    CHECK(says(wrong, "7 more while listening, 10 in all"));
  }
}

TEST_CASE("a reverse path filter that drops is an error") {
  Facts facts = healthy_facts();
  facts.reverse_path_filter = {{"all", 0}, {"eth0", 1}};
  CHECK(says(check_reverse_path(facts).front(), "strict on eth0"));
  CHECK(count_of(check_reverse_path(facts), Verdict::kWrong) == 0);
  facts.after->reverse_path_drops = 4;
  CHECK(the_wrong_one(check_reverse_path(facts)).mend ==
        "sysctl -w net.ipv4.conf.all.rp_filter=0 net.ipv4.conf.eth0.rp_filter=0");
}

TEST_CASE("the programs at the port are named") {
  Facts facts = healthy_facts();
  facts.sockets_at_port = 3;
  facts.port_users = {{{"puck-tracker", 41}, 2}};
  const Finding finding = check_port_users(facts).front();
  CHECK(says(finding, "puck-tracker (pid 41)"));
  CHECK(says(finding, "that this user may not see"));
}

}  // namespace puck
