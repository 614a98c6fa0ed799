// Quadratic error of a position: p^T A p + 2 b.p + c (Garland and Heckbert 1997).
#pragma once

#include <glm/glm.hpp>
#include <optional>

namespace jalousie::bake {

struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  glm::dvec3 b{0.0};
  double c = 0.0;

  /// Adds w (g.p + d)^2.
  void addPlane(const glm::dvec3& g, double d, double w) {
    xx += w * g.x * g.x;
    xy += w * g.x * g.y;
    xz += w * g.x * g.z;
    yy += w * g.y * g.y;
    yz += w * g.y * g.z;
    zz += w * g.z * g.z;
    b += w * d * g;
    c += w * d * d;
  }
  /// Adds w |p - q|^2.
  void addPoint(const glm::dvec3& q, double w) {
    xx += w;
    yy += w;
    zz += w;
    b -= w * q;
    c += w * glm::dot(q, q);
  }
  void operator+=(const Quadric& o) {
    xx += o.xx;
    xy += o.xy;
    xz += o.xz;
    yy += o.yy;
    yz += o.yz;
    zz += o.zz;
    b += o.b;
    c += o.c;
  }
  glm::dvec3 times(const glm::dvec3& p) const {
    return {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z, xz * p.x + yz * p.y + zz * p.z};
  }
  double at(const glm::dvec3& p) const { return glm::dot(p, times(p)) + 2.0 * glm::dot(b, p) + c; }
  /// The position of least error by Cholesky factorisation; nothing if a pivot vanishes beside the trace.
  std::optional<glm::dvec3> minimum() const {
    const double limit = 1e-10 * (xx + yy + zz);
    if (!(xx > limit)) return std::nullopt;
    const double l10 = xy / xx;
    const double l20 = xz / xx;
    const double d1 = yy - l10 * xy;
    if (!(d1 > limit)) return std::nullopt;
    const double e = yz - l20 * xy;
    const double l21 = e / d1;
    const double d2 = zz - l20 * xz - l21 * e;
    if (!(d2 > limit)) return std::nullopt;
    const double y0 = -b.x;
    const double y1 = -b.y - l10 * y0;
    const double y2 = -b.z - l20 * y0 - l21 * y1;
    const double z = y2 / d2;
    const double y = y1 / d1 - l21 * z;
    return glm::dvec3(y0 / xx - l10 * y - l20 * z, y, z);
  }
};

}  // namespace jalousie::bake
