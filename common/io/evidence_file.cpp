#include "common/io/evidence_file.h"

#include <string>

#include "common/io/calibration_text.h"
#include "common/io/config.h"
#include "common/io/toml_entries.h"
#include "common/vision/hypotheses/evidence_numbers.h"

namespace puck {

EvidenceParams read_evidence_file(const std::filesystem::path& path) {
  Config config = Config::from_file(path);
  EvidenceParams params;
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    const std::string key = std::string("evidence.") + number.name;
    if (!config.has(key)) config.fail(key, "is missing");
    config.read(key, params.*number.value, number.lowest, number.highest);
  }
  config.reject_unknown_in("evidence");
  return params;
}

void write_evidence_file(const std::filesystem::path& path, const EvidenceParams& params,
                         std::string_view provenance) {
  std::string text =
      toml_comment(provenance) +
      "# What preset default has learned of the events near pucks and near anything "
      "else\n# (common/vision/hypotheses/evidence.h). A concentration is the number of events "
      "after which a share\n# that was seen outweighs the expected one.\n[evidence]\n";
  for (const EvidenceNumber& number : kEvidenceNumbers) {
    text += std::string(number.name) + " = " + toml_number(params.*number.value) + "  # " +
            number.meaning + "\n";
  }
  write_calibration_text(path, text);
}

}  // namespace puck
