#include "tools/play/logged_game.h"

#include <optional>
#include <stdexcept>

#include "common/messaging/conversions.h"
#include "common/messaging/log_file.h"

namespace puck {
namespace {

template <typename Message>
void take(const LogRecord& record, std::optional<Message>& newest) {
  Message message;
  if (!decode(record.bytes, message)) newest = message;
}

}  // namespace

SaveFigures figures_of_log(const std::filesystem::path& path) {
  LogReader reader(path);
  LogRecord record;
  std::optional<GroundTruth> truth;
  std::optional<GameState> game;
  std::optional<std::int64_t> first_utime;
  std::int64_t last_utime = 0;
  while (reader.next(record)) {
    const auto channel = find_channel(record.channel, "");
    if (channel == Channel::kTruth) take(record, truth);
    if (channel == Channel::kGame) take(record, game);
    if (channel == Channel::kTruth) {
      if (!first_utime) first_utime = record.utime;
      last_utime = record.utime;
    }
  }
  if (!truth) throw std::runtime_error(path.string() + ": no TRUTH of a simulated game in it");
  SaveFigures figures;
  figures.shots = truth->shots;
  figures.saves = truth->saves;
  figures.goals = truth->goals_against;
  if (game) {
    figures.believed_shots = game->shots;
    figures.believed_saves = game->saves;
    figures.believed_goals = game->goals_against;
  }
  figures.played_s = static_cast<double>(truth->time.us) * 1e-6;
  figures.took_s = static_cast<double>(last_utime - first_utime.value_or(last_utime)) * 1e-6;
  return figures;
}

}  // namespace puck
