#include "tools/view/server/control_json.h"

#include <array>
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "tools/view/interface/view_scene.h"

namespace puck {
namespace {

using Action = ViewControl::Action;

constexpr std::array<std::pair<std::string_view, Action>, 8> kActions{
    {{"play", Action::kPlay},
     {"pause", Action::kPause},
     {"step", Action::kStep},
     {"seek", Action::kSeek},
     {"speed", Action::kSpeed},
     {"tracker", Action::kTracker},
     {"next_loss", Action::kNextLoss},
     {"previous_loss", Action::kPreviousLoss}}};

constexpr std::size_t kLongestName = 64;

}  // namespace

std::variant<ViewControl, std::string> parse_control(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("action") || !json["action"].is_string()) {
    return "expected a JSON object with an action, such as {\"action\": \"pause\"}";
  }
  ViewControl control;
  const auto& wanted = json["action"].get_ref<const std::string&>();
  bool is_known = false;
  for (const auto& [name, action] : kActions) {
    if (name != wanted) continue;
    control.action = action;
    is_known = true;
  }
  if (!is_known) {
    std::string names;
    for (const auto& entry : kActions)
      names += (names.empty() ? "" : ", ") + std::string(entry.first);
    return "unknown action; expected one of " + names;
  }
  if (const auto value = json.find("value"); value != json.end()) {
    if (!value->is_number()) return "value must be a number";
    control.value = value->get<double>();
    if (!std::isfinite(control.value)) return "value must be a finite number";
  }
  if (const auto side = json.find("side"); side != json.end()) {
    if (*side != 0 && *side != 1) return "side must be 0 or 1";
    control.side = side->get<int>();
  }
  if (const auto name = json.find("name"); name != json.end()) {
    if (!name->is_string() || name->get_ref<const std::string&>().size() > kLongestName) {
      return "name must be a text of up to " + std::to_string(kLongestName) + " bytes";
    }
    control.name = name->get<std::string>();
  }
  return control;
}

}  // namespace puck
