#include "tools/info/plots.h"

#include <fstream>
#include <stdexcept>
#include <system_error>

#include "common/io/temporary_path.h"
#include "tools/charts/draw_charts.h"
#include "tools/info/report.h"

namespace puck {
void draw_survey(const Survey& survey, const std::filesystem::path& folder) {
  if (survey.counters.events == 0) throw std::runtime_error("--plots: there are no events to draw");
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(folder.string() +
                             ": the folder cannot be created: " + error.message());
  }
  const TemporaryPath json("puck-info-");
  std::ofstream(json.path(), std::ios::binary) << survey_json(survey, true);
  draw_charts("info", {json.path().string(), folder.string()});
}

}  // namespace puck
