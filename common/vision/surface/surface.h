#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "common/events/event.h"
#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"
#include "common/vision/surface/eros_strips.h"
#include "common/vision/surface/grey_table.h"
#include "common/vision/surface/sae_pixels.h"
#include "common/vision/surface/sits_pixels.h"
#include "common/vision/surface/surface_snapshot.h"

namespace puck {

struct ErosParams {
  /// The paper's k: the decayed window is 2k + 1 pixels wide. 1 to 8.
  int half_width_px = 5;
  /// The paper's d: factor by which an event fades its neighbours. Larger keeps old edges longer.
  double decay = 0.786;
  ErosRounding rounding = ErosRounding::kNearest;
};

struct TosParams {
  /// The window is 2 · this + 1 pixels wide: luvHarris' k, which is 7 there. 1 to 8.
  int half_width_px = 3;
  /// A pixel below 255 − this becomes dark; luvHarris has 2k. 1 to 254.
  int depth = 14;
};

/// Names the surface, and holds its settings.
using SurfaceParams = std::variant<ErosParams, TosParams, SitsParams, SaeParams>;

enum class SurfaceKind : std::uint8_t {
  kEros,  ///< Exponential Reduced Ordinal Surface.
  kTos,   ///< Threshold-Ordinal Surface.
  kSits,  ///< Speed Invariant Time Surface.
  kSae,   ///< Surface of Active Events.
};

/// By kind.
inline constexpr std::array<std::string_view, 4> kSurfaceNames{"eros", "tos", "sits", "sae"};

/// One of kSurfaceNames.
const char* to_string(SurfaceKind kind);
std::optional<SurfaceKind> surface_kind_from(std::string_view name);

/// A part of the surface with its stamps, taken on the event thread and developed on another.
struct SurfaceExposure {
  SurfaceCounts counts;
  Timestamp newest_event;           ///< Newest event on the surface when it was taken.
  std::int64_t events_applied = 0;  ///< Events applied to the surface until then.
};

/// A picture that each event changes, in 8 bits a pixel:
///
/// - EROS, the Exponential Reduced Ordinal Surface (paper, Algorithm 1): an event sets its pixel to
///   255 and multiplies the pixels around it by the decay. Exact and without a multiplication: a
///   pixel holds 255 − n, n the events in its window since its own last one, and is converted to
///   the grey value 255·dⁿ only when it is read.
/// - TOS, the Threshold-Ordinal Surface (Glover, Dinale, De Souza Rosa, Bamford and Bartolozzi:
///   luvHarris, TPAMI 2021): an event subtracts 1 from the pixels around it, which are dark below a
///   threshold, and sets its own to 255. The same counts as those of EROS, with other grey values.
/// - SITS and SAE: see SitsPixels and SaePixels.
///
/// One thread at a time, except develop().
class Surface {
 public:
  /// Throws std::invalid_argument, naming the key, when a parameter is out of range.
  Surface(SensorSize size, const SurfaceParams& params);

  /// Every event must lie inside the sensor. Batches and single events give the same surface.
  /// Without a packet's start, newest_event() stays, and SAE takes the events' times from 0.
  void update(const Event& event);
  void update(std::span<const Event> events);
  void update(const EventPacket& packet);
  /// Like the batch form, for a part of a packet that starts at `start`. `events` is not empty.
  void update(Timestamp start, std::span<const Event> events);

  /// Keeps only `region` up to date from now on, which is cheaper: events outside its reach are
  /// counted but not applied. Pixels outside the region become dark, and pixels that enter it later
  /// start dark. The whole sensor, as at the start, keeps all. SITS also differs from a whole surface
  /// near the region's border, where the pixels beyond are not up to date.
  void keep_only(const Region& region);

  /// Copies the part of `region` that lies inside the sensor.
  void snapshot(const Region& region, SurfaceSnapshot& out);

  /// snapshot() in two steps: the first is quick …
  void take(const Region& region, SurfaceExposure& out) const;
  /// … and the second, which overwrites `taken`, may run while another thread updates the surface.
  void develop(SurfaceExposure& taken, SurfaceSnapshot& out) const;
  /// As develop(), but into its place in `out`, whose region contains that of `taken`.
  void develop_part(SurfaceExposure& taken, SurfaceSnapshot& out) const;

  SensorSize size() const { return size_; }
  std::int64_t events_applied() const { return events_applied_; }
  Timestamp newest_event() const { return newest_event_; }

 private:
  // Chosen for each batch of events, not for each event.
  using Pixels = std::variant<ErosStrips, SitsPixels, SaePixels>;

  static Pixels pixels_of(SensorSize size, const SurfaceParams& params);
  static GreyValues greys_of(const SurfaceParams& params, const Pixels& pixels);
  void apply(Timestamp start, std::span<const Event> events);
  void apply_to_pixels(Timestamp start, std::span<const Event> events);
  void clear(const Region& region);

  SensorSize size_;
  int half_width_;  // of an event's window
  Pixels pixels_;
  GreyTable grey_;
  Region kept_;            // the part kept up to date
  SurfaceExposure taken_;  // of a snapshot
  std::int64_t events_applied_ = 0;
  Timestamp newest_event_;
};

}  // namespace puck
