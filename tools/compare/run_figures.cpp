#include "tools/compare/run_figures.h"

#include <stdexcept>

#include "tools/compare/program.h"

namespace puck {
RunFigures::RunFigures(const Result& result) : result_(result) {
  const std::filesystem::path path = result.folder / "figures.json";
  try {
    json_ = nlohmann::ordered_json::parse(read_whole_file(path));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

std::optional<double> RunFigures::number(const std::string& key) const {
  const auto found = json_.find(key);
  if (found == json_.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

}  // namespace puck
