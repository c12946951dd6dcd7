#include "tools/doctor/checks.h"
#include "tools/doctor/commands.h"
#include "tools/doctor/live_services.h"

namespace puck {

Findings check_versions(const Facts& facts) {
  constexpr const char* kVersions = "versions";
  Findings findings;
  const auto services = live_services(facts);
  for (const HeardService* service : services) {
    const service_status_t& status = service->status;
    if (status.version == facts.version) continue;
    findings.push_back({Verdict::kWrong, kVersions,
                        status.service + " on " + status.host + " is version " + status.version +
                            ", this is " + facts.version +
                            "; install one version everywhere. On the older host, in its clone",
                        kUpdate});
  }
  if (findings.empty()) {
    findings.push_back({Verdict::kOk, kVersions,
                        services.empty() ? "no service sends STATUS, so there is no version to "
                                           "compare"
                                         : "all are version " + facts.version});
  }
  return findings;
}

}  // namespace puck
