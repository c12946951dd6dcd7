#pragma once

namespace puck {

/// A position or direction in the table's frame: x and y as in TablePoint, z up from the playing
/// surface, m.
struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr Vector3 operator+(Vector3 a, Vector3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(Vector3 a, Vector3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator*(double factor, Vector3 a) {
    return {factor * a.x, factor * a.y, factor * a.z};
  }
};

constexpr double dot(Vector3 a, Vector3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace puck
