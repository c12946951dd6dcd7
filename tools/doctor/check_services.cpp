#include <map>

#include "common/messaging/status_reporter.h"
#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"
#include "tools/doctor/doctor_name.h"
#include "tools/doctor/live_services.h"

namespace puck {
namespace {

constexpr const char* kServices = "services";

std::string describe(const HeardService& service) {
  const service_status_t& status = service.status;
  std::string text = status.service + " on " + status.host + " (" + service.source.address +
                     "), pid " + std::to_string(status.pid) + ", version " + status.version + ", " +
                     to_string(static_cast<ServiceState>(status.state));
  if (!status.state_text.empty()) text += ": " + status.state_text;
  return text;
}

bool is_well(const HeardService& service) {
  return service.status.state == service_status_t::STATE_RUNNING ||
         service.status.state == service_status_t::STATE_STARTING;
}

Findings silence(const Facts& facts) {
  const std::set<std::string>& prefixes = facts.traffic.other_prefixes();
  const std::string under =
      facts.prefix.empty() ? "without a prefix" : "under the prefix " + facts.prefix;
  if (!prefixes.empty()) {
    std::string others;
    for (const std::string& prefix : prefixes) {
      others += (others.empty() ? "" : ", ") + (prefix.empty() ? "none" : prefix);
    }
    return {{Verdict::kWrong, kServices,
             "no STATUS of any service " + under +
                 ", but there are services under other prefixes: " + others,
             "--prefix \"" + *prefixes.begin() + "\""}};
  }
  return {{Verdict::kNote, kServices,
           "no STATUS of any service " + under +
               ". If services run on other hosts, run the doctor there with the same bus",
           std::string(kDoctorName) + " " + lcm_url_option(facts.url) +
               (facts.prefix.empty() ? "" : " --prefix " + facts.prefix)}};
}

/// The newer service is assumed to be the unwanted one.
std::string end_the_newer(const Facts& facts, const HeardService& a, const HeardService& b) {
  const HeardService& newer = a.status.uptime_us < b.status.uptime_us ? a : b;
  const std::string kill = "kill " + std::to_string(newer.status.pid);
  if (facts.is_own_address(newer.source.address)) return as_root(facts, {kill});
  return "ssh " + newer.source.address + " " + kill;
}

}  // namespace

Findings check_services(const Facts& facts) {
  const auto services = live_services(facts);
  if (services.empty()) return silence(facts);
  Findings findings;
  std::map<std::string, const HeardService*> by_name;
  for (const HeardService* service : services) {
    findings.push_back(
        {is_well(*service) ? Verdict::kOk : Verdict::kNote, kServices, describe(*service)});
    const auto [known, is_new] = by_name.emplace(service->status.service, service);
    if (is_new) continue;
    findings.push_back({Verdict::kWrong, kServices,
                        "two services of one kind under one prefix: " + service->status.service +
                            " on " + known->second->status.host + " (pid " +
                            std::to_string(known->second->status.pid) + ") and on " +
                            service->status.host + " (pid " + std::to_string(service->status.pid) +
                            "); stop one, or give it a --prefix of its own",
                        end_the_newer(facts, *known->second, *service)});
  }
  return findings;
}

}  // namespace puck
