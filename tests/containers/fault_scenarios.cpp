// Games in which a machine dies, freezes or loses its network.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/containers/scenarios.h"

namespace puck {
namespace {

constexpr std::int64_t kReturnUs = 1'000'000;
constexpr std::int64_t kNoticeUs = 500'000;
// A shorter silence is no fault.
constexpr std::int64_t kShortestFaultUs = 400'000;

template <typename Message, typename Condition>
const Heard<Message>* first_after(const std::vector<Heard<Message>>& all, std::int64_t after_us,
                                  const Condition& condition) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Heard<Message>& heard) {
    return heard.at_us >= after_us && condition(heard.message);
  });
  return found == all.end() ? nullptr : &*found;
}

bool stands_still(const arm_state_t& state) { return state.state == arm_state_t::STATE_HOLDING; }

// Holding because of missing data, not at its target.
bool holds_for_a_reason(const arm_state_t& state) {
  return stands_still(state) && !state.reason.empty();
}

template <typename Message>
void demand_within(const std::string& what, const Heard<Message>* came, std::int64_t since_us,
                   std::int64_t asked_us, Verdict& verdict) {
  verdict.demand_within(what, came != nullptr, came != nullptr ? came->at_us - since_us : 0,
                        asked_us);
}

// From the arm's reaction to the end of the silence.
void demand_standstill(const BusLog& log, const Silence& silence, Verdict& verdict) {
  const auto* noticed = first_after(log.arm_states, silence.begin_us, holds_for_a_reason);
  const bool in_time = noticed != nullptr && noticed->at_us < silence.end_us;
  demand_within("arm still", in_time ? noticed : nullptr, silence.begin_us, kNoticeUs, verdict);
  if (!in_time) return;
  const auto moves = [&](const Heard<arm_state_t>& heard) {
    return heard.at_us > noticed->at_us && heard.at_us < silence.end_us &&
           !stands_still(heard.message);
  };
  const auto moved = std::count_if(log.arm_states.begin(), log.arm_states.end(), moves);
  verdict.demand(moved == 0, "the arm moved in " + std::to_string(moved) + " states meanwhile");
}

// Another service names the silent one in its STATUS.
void demand_noticed(const BusLog& log, const std::string& service, const Silence& silence,
                    Verdict& verdict) {
  const auto names_it = [&](const service_status_t& status) {
    return status.service != service && status.state_text.find(service) != std::string::npos &&
           status.state_text.find("silent") != std::string::npos;
  };
  const auto* noticed = first_after(log.statuses, silence.begin_us, names_it);
  const bool in_time = noticed != nullptr && noticed->at_us < silence.end_us;
  demand_within("noticed", in_time ? noticed : nullptr, silence.begin_us, kNoticeUs, verdict);
}

// A command that was followed and is based on an estimate of this tracker.
auto follows_tracker(std::int64_t tracker_session) {
  return [tracker_session](const arm_state_t& state) {
    return state.command_session != 0 && state.estimate_session == tracker_session;
  };
}

void demand_one_life_but(const std::string& service, const BusLog& log, Verdict& verdict) {
  for (const std::string other :
       {"puck-camera", "puck-tracker", "puck-bridge", "puck-arm", "puck-logger"}) {
    if (other == service) continue;
    const std::size_t lives = runs_of(log, other).size();
    verdict.demand(lives == 1, other + " began " + std::to_string(lives) + " times");
  }
}

}  // namespace

void judge_killed_tracker(const GameRecord& game, Verdict& verdict) {
  const BusLog& log = game.log;
  demand_one_life_but("puck-tracker", log, verdict);
  const std::vector<ServiceRun> lives = runs_of(log, "puck-tracker");
  verdict.demand(lives.size() == 2, "the tracker lived " + std::to_string(lives.size()) + " times");
  if (lives.size() != 2) return;
  const ServiceRun& before = lives[0];
  const ServiceRun& after = lives[1];
  verdict.demand(!before.has_said_goodbye(), "the tracker was not killed but stopped");

  const std::int64_t killed_us = log.heard_us.at(before.session).back();
  demand_noticed(log, "puck-tracker", {killed_us, log.heard_us.at(after.session).front()}, verdict);
  const auto is_back = [&](const puck_estimate_t& estimate) {
    return estimate.session == after.session && estimate.events_applied > 0;
  };
  const auto tracks = [&](const puck_estimate_t& estimate) {
    return is_back(estimate) && estimate.state == puck_estimate_t::STATE_TRACKING;
  };
  const auto* back = first_after(log.estimates, 0, is_back);
  demand_within("back", back, after.started_us, kReturnUs, verdict);
  // When the puck is found and the arm has a reason to move depends on the game.
  const auto* tracked = first_after(log.estimates, 0, tracks);
  verdict.demand(tracked != nullptr, "the new tracker never tracked the puck");
  verdict.demand(first_after(log.arm_states, 0, follows_tracker(after.session)) != nullptr,
                 "the arm never followed the new tracker");
  if (tracked != nullptr) demand_standstill(log, {killed_us, tracked->at_us}, verdict);
}

void judge_frozen_bridge(const GameRecord& game, Verdict& verdict) {
  const BusLog& log = game.log;
  demand_one_life_but("", log, verdict);
  const std::vector<ServiceRun> lives = runs_of(log, "puck-bridge");
  if (lives.empty()) return;
  const std::int64_t session = lives[0].session;
  const std::optional<Silence> silence = longest_silence(log, session);
  if (!silence || silence->end_us - silence->begin_us < kShortestFaultUs) {
    verdict.demand(false, "the bridge was never frozen");
    return;
  }
  verdict.note("frozen for " + std::to_string((silence->end_us - silence->begin_us) / 1000) +
               " ms");
  demand_noticed(log, "puck-bridge", *silence, verdict);
  demand_standstill(log, *silence, verdict);
  const auto follows = [&](const arm_state_t& state) {
    return state.command_session == session && state.reason.empty();
  };
  verdict.demand(first_after(log.arm_states, silence->end_us, follows) != nullptr,
                 "the arm never followed the bridge again");
}

void judge_cut_off_tracker(const GameRecord& game, Verdict& verdict) {
  const BusLog& log = game.log;
  demand_one_life_but("", log, verdict);
  const std::vector<ServiceRun> lives = runs_of(log, "puck-tracker");
  if (lives.empty()) return;
  const std::int64_t session = lives[0].session;
  const std::optional<Silence> silence = longest_silence(log, session);
  if (!silence || silence->end_us - silence->begin_us < kShortestFaultUs) {
    verdict.demand(false, "the tracker was never cut off");
    return;
  }
  verdict.note("cut off for " + std::to_string((silence->end_us - silence->begin_us) / 1000) +
               " ms");
  demand_noticed(log, "puck-tracker", *silence, verdict);
  demand_standstill(log, *silence, verdict);
  std::int64_t newest_event_us = 0;
  for (const auto& [at_us, estimate] : log.estimates) {
    if (at_us <= silence->begin_us) newest_event_us = estimate.sensor_us;
  }
  // Events from after the cut: earlier ones may have been queued.
  const auto hears_again = [&](const puck_estimate_t& estimate) {
    return estimate.sensor_us > newest_event_us + (silence->end_us - silence->begin_us) / 2;
  };
  const auto* again = first_after(log.estimates, silence->end_us, hears_again);
  demand_within("hears again", again, silence->end_us, kReturnUs, verdict);
  verdict.demand(again != nullptr &&
                     first_after(log.arm_states, again->at_us, follows_tracker(session)) != nullptr,
                 "the arm never followed the tracker again");
}

}  // namespace puck
