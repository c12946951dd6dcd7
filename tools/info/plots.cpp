#include "tools/info/plots.h"

#include <stdexcept>
#include <string>
#include <system_error>

#include "common/io/text_file.h"
#include "common/io/unnamed_file.h"
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
  UnnamedFile json("puck-info-");
  const std::string path = json.path();
  write_text_file(path, survey_json(survey, true));
  draw_charts("info", {path, folder.string()});
}

}  // namespace puck
