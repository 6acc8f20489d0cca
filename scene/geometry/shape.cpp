#include "scene/geometry/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/units.h"

namespace bpms {
namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

struct LocalLine {
  Eigen::Vector3d origin, direction;
};
LocalLine to_frame(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
  return {shape.rotation.back(origin - shape.centre_m.cast<double>()), shape.rotation.back(direction)};
}

int ellipsoid_crossings(const Shape& shape, const LocalLine& line, std::array<ShapeCrossing, 2>& out) {
  const Eigen::Array3d radii = shape.size_m.cast<double>().array();
  const Eigen::Vector3d o = line.origin.array() / radii, d = line.direction.array() / radii;
  // From the point nearest to the centre, so that nothing cancels for lines that come from afar.
  const double a = d.squaredNorm(), nearest = -o.dot(d) / a;
  const Eigen::Vector3d p = o + nearest * d;
  const double rest = 1 - p.squaredNorm();
  if (!(rest >= 0)) return 0;
  const double half = std::sqrt(rest / a);
  out[0] = {nearest - half, shape_side, true, (p - half * d).normalized()};
  out[1] = {nearest + half, shape_side, false, (p + half * d).normalized()};
  return 2;
}

// The part of a line that lies within the (infinite) cone or cylinder of the side, on the sheet where its
// radius is not below 0: a t^2 + 2 b t + c <= 0.
bool within_side(double a, double b, double c, double widening, double length2, double& from, double& to) {
  from = -forever, to = forever;
  constexpr double parallel = 1e-15;
  if (std::abs(a) <= parallel * length2) {
    if (b == 0 || std::abs(b) * std::abs(b) <= parallel * parallel * length2 * std::abs(c)) return c <= 0;
    (b > 0 ? to : from) = -c / (2 * b);
    return true;
  }
  const double square = b * b - a * c;
  if (a > 0 && square < 0) return false;
  const double q = -(b + std::copysign(std::sqrt(std::max(0.0, square)), b));
  double low = q / a, high = q != 0 ? c / q : low;
  if (low > high) std::swap(low, high);
  if (a > 0) {
    from = low, to = high;
  } else if (widening > 0) {
    from = high;
  } else {
    to = low;
  }
  return true;
}

int cylinder_crossings(const Shape& shape, const LocalLine& line, std::array<ShapeCrossing, 2>& out) {
  const double r0 = shape.size_m[0], length = shape.size_m[2];
  const double k = (static_cast<double>(shape.size_m[1]) - r0) / length;
  const Eigen::Vector3d& d = line.direction;
  const double length2 = d.squaredNorm();
  const double shift = (Eigen::Vector3d(0, 0, 0.5 * length) - line.origin).dot(d) / length2;
  const Eigen::Vector3d o = line.origin + shift * d;
  const double r = r0 + k * o.z();
  const double a = d.x() * d.x() + d.y() * d.y() - k * k * d.z() * d.z();
  const double b = o.x() * d.x() + o.y() * d.y() - k * r * d.z();
  const double c = o.x() * o.x() + o.y() * o.y() - r * r;
  double from = 0, to = 0;
  if (!within_side(a, b, c, k * d.z(), length2, from, to)) return 0;
  const auto at = [&](double t) { return Eigen::Vector3d(o + t * d); };
  int count = 0;
  if (!shape.closed) {
    for (const bool entering : {true, false}) {
      const double t = entering ? from : to;
      if (!std::isfinite(t)) continue;
      const Eigen::Vector3d p = at(t);
      if (p.z() >= 0 && p.z() <= length)
        out[static_cast<std::size_t>(count++)] = {t + shift, shape_side, entering, p};
    }
    return count;
  }
  int first_part = shape_side, second_part = shape_side;
  if (d.z() != 0) {
    double in = -o.z() / d.z(), away = (length - o.z()) / d.z();
    int in_part = shape_first_end, away_part = shape_second_end;
    if (in > away) std::swap(in, away), std::swap(in_part, away_part);
    if (in > from) from = in, first_part = in_part;
    if (away < to) to = away, second_part = away_part;
  } else if (o.z() < 0 || o.z() > length) {
    return 0;
  }
  if (!(from <= to) || !std::isfinite(from) || !std::isfinite(to)) return 0;
  out[0] = {from + shift, first_part, true, at(from)};
  out[1] = {to + shift, second_part, false, at(to)};
  return 2;
}

double radius_at(const Shape& shape, double z) {
  return shape.size_m[0] + (static_cast<double>(shape.size_m[1]) - shape.size_m[0]) * z / shape.size_m[2];
}

double azimuth_share(double x, double y) {
  const double share = std::atan2(y, x) / (2 * pi);
  return share < 0 ? std::min(share + 1, std::nextafter(1.0, 0.0)) : share;
}

// Outward and unit, of a cylinder's side at an azimuth.
Eigen::Vector3d side_normal(const Shape& shape, double cosine, double sine) {
  const double k = (static_cast<double>(shape.size_m[1]) - shape.size_m[0]) / shape.size_m[2];
  return Eigen::Vector3d(cosine, sine, -k).normalized();
}

Eigen::Vector2d azimuth_of(const Eigen::Vector3d& p) {
  const double radius = p.head<2>().norm();
  return radius > 0 ? Eigen::Vector2d(p.head<2>() / radius) : Eigen::Vector2d(1, 0);
}

// A unit rotation that takes z to the direction.
Rotation z_towards(const Eigen::Vector3d& direction) {
  return Rotation(Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), direction));
}

}  // namespace

Shape sphere(const Eigen::Vector3d& centre_m, double radius_m, std::uint32_t material) {
  return ellipsoid(centre_m, Eigen::Vector3d::Constant(radius_m), {}, material);
}

Shape ellipsoid(const Eigen::Vector3d& centre_m, const Eigen::Vector3d& radii_m, const Rotation& rotation,
                std::uint32_t material) {
  return {centre_m.cast<float>(), rotation, radii_m.cast<float>(), material, Shape::Kind::ellipsoid, true};
}

Shape cylinder(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, double first_radius_m,
               double second_radius_m, bool closed, std::uint32_t material) {
  const Eigen::Vector3d axis = to_m - from_m;
  const Eigen::Vector3d size(first_radius_m, second_radius_m, axis.norm());
  return {from_m.cast<float>(), z_towards(axis), size.cast<float>(), material, Shape::Kind::cylinder, closed};
}

int shape_crossings(const Shape& shape, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                    std::array<ShapeCrossing, 2>& out) {
  const LocalLine line = to_frame(shape, origin, direction);
  return shape.kind == Shape::Kind::ellipsoid ? ellipsoid_crossings(shape, line, out)
                                              : cylinder_crossings(shape, line, out);
}

ShapePoint shape_point(const Shape& shape, int part, const Eigen::Vector3f& at) {
  ShapePoint out;
  Eigen::Vector3d p, n, du = Eigen::Vector3d::Zero(), dv = du;
  if (shape.kind == Shape::Kind::ellipsoid) {
    const Eigen::Array3d radii = shape.size_m.cast<double>().array();
    const Eigen::Vector3d s = at.cast<double>().normalized();
    p = s.array() * radii;
    n = (s.array() / radii).matrix().normalized();
    const Eigen::Vector2d azimuth = azimuth_of(s);
    const double out_by = s.head<2>().norm();
    out.uv = {azimuth_share(azimuth.x(), azimuth.y()), std::acos(std::clamp(-s.z(), -1.0, 1.0)) / pi};
    du = 2 * pi * Eigen::Array3d(-s.y(), s.x(), 0) * radii;
    dv = pi * Eigen::Array3d(-s.z() * azimuth.x(), -s.z() * azimuth.y(), out_by) * radii;
  } else {
    p = at.cast<double>();
    const Eigen::Vector2d azimuth = azimuth_of(p);
    const double length = shape.size_m[2];
    if (part == shape_side) {
      const double radius = radius_at(shape, p.z()), widening = shape.size_m[1] - shape.size_m[0];
      p.head<2>() = radius * azimuth;
      n = side_normal(shape, azimuth.x(), azimuth.y());
      du = 2 * pi * radius * Eigen::Vector3d(-azimuth.y(), azimuth.x(), 0);
      dv = {widening * azimuth.x(), widening * azimuth.y(), length};
    } else {
      p.z() = part == shape_first_end ? 0 : length;
      n = {0, 0, part == shape_first_end ? -1.0 : 1.0};
    }
    out.uv = {azimuth_share(azimuth.x(), azimuth.y()), std::clamp(p.z() / length, 0.0, 1.0)};
  }
  out.position = shape.centre_m.cast<double>() + shape.rotation * p;
  out.normal = shape.rotation * n;
  out.dp_du = shape.rotation * du;
  out.dp_dv = shape.rotation * dv;
  return out;
}

Eigen::Vector3d shape_normal(const Shape& shape, int part, const Eigen::Vector3d& position) {
  const Eigen::Vector3d p = shape.rotation.back(position - shape.centre_m.cast<double>());
  Eigen::Vector3d n;
  if (shape.kind == Shape::Kind::ellipsoid) {
    n = (p.array() / shape.size_m.cast<double>().array().square()).matrix();
    if (!(n.squaredNorm() > 0)) n = Eigen::Vector3d::UnitZ();
  } else if (part == shape_side) {
    const Eigen::Vector2d azimuth = azimuth_of(p);
    n = side_normal(shape, azimuth.x(), azimuth.y());
  } else {
    n = {0, 0, part == shape_first_end ? -1.0 : 1.0};
  }
  return shape.rotation * n.normalized();
}

double shape_offset(const Shape& shape, int part, const Eigen::Vector3d& position) {
  const Eigen::Vector3d p = shape.rotation.back(position - shape.centre_m.cast<double>());
  if (shape.kind == Shape::Kind::ellipsoid) {
    const Eigen::Array3d radii = shape.size_m.cast<double>().array();
    const Eigen::Vector3d s = p.array() / radii;
    const double level = s.norm();
    if (!(level > 0)) return -radii.minCoeff();
    return (level - 1) * level / (s.array() / radii).matrix().norm();
  }
  if (part == shape_first_end) return -p.z();
  if (part == shape_second_end) return p.z() - shape.size_m[2];
  const double k = (static_cast<double>(shape.size_m[1]) - shape.size_m[0]) / shape.size_m[2];
  return (p.head<2>().norm() - radius_at(shape, p.z())) / std::hypot(1.0, k);
}

bool shape_contains(const Shape& shape, const Eigen::Vector3d& position) {
  if (!shape.closed) return false;
  const Eigen::Vector3d p = shape.rotation.back(position - shape.centre_m.cast<double>());
  if (shape.kind == Shape::Kind::ellipsoid)
    return (p.array() / shape.size_m.cast<double>().array()).matrix().squaredNorm() < 1;
  return p.z() > 0 && p.z() < shape.size_m[2] && p.head<2>().norm() < radius_at(shape, p.z());
}

double shape_area_m2(const Shape& shape) {
  const Eigen::Vector3d s = shape.size_m.cast<double>();
  if (shape.kind == Shape::Kind::cylinder) {
    const double slant = std::hypot(s[2], s[1] - s[0]);
    return pi * (s[0] + s[1]) * slant + (shape.closed ? pi * (s[0] * s[0] + s[1] * s[1]) : 0);
  }
  // The mean over the unit sphere of the area that a piece of it is stretched to; by the midpoint rule, which
  // converges fast on periodic functions, in the azimuth, and by Simpson's in z.
  constexpr int azimuths = 128, steps = 512;
  double sum = 0;
  for (int j = 0; j <= steps; ++j) {
    const double z = -1 + 2.0 * j / steps, rho2 = std::max(0.0, 1 - z * z);
    const double weight = j == 0 || j == steps ? 1 : j % 2 ? 4 : 2;
    for (int i = 0; i < azimuths; ++i) {
      const double phi = (i + 0.5) * pi / (2 * azimuths);  // a quarter stands for all
      const double x2 = rho2 * std::pow(std::cos(phi), 2), y2 = rho2 * std::pow(std::sin(phi), 2);
      sum += weight * std::sqrt(x2 * std::pow(s[1] * s[2], 2) + y2 * std::pow(s[0] * s[2], 2) +
                                z * z * std::pow(s[0] * s[1], 2));
    }
  }
  return 4 * pi * sum / (3.0 * steps * azimuths);
}

double shape_thinnest_m(const Shape& shape) {
  const Eigen::Vector3d s = shape.size_m.cast<double>();
  if (shape.kind == Shape::Kind::ellipsoid) return 2 * s.minCoeff();
  return std::min(2 * std::max(s[0], s[1]), s[2]);
}

void shape_box(const Shape& shape, Eigen::Vector3d& middle, Eigen::Vector3d& half) {
  const Eigen::Matrix3d axes = shape.rotation.matrix();
  const Eigen::Vector3d s = shape.size_m.cast<double>();
  middle = shape.centre_m.cast<double>();
  if (shape.kind == Shape::Kind::ellipsoid) {
    half = (axes * s.asDiagonal()).rowwise().norm();
    return;
  }
  const Eigen::Vector3d axis = axes.col(2), second = middle + s[2] * axis;
  const Eigen::Vector3d rim = (1 - axis.array().square()).max(0.0).sqrt();
  const Eigen::Vector3d low = (middle - s[0] * rim).cwiseMin(second - s[1] * rim);
  const Eigen::Vector3d high = (middle + s[0] * rim).cwiseMax(second + s[1] * rim);
  middle = 0.5 * (low + high);
  half = 0.5 * (high - low);
}

Eigen::Vector3d shape_support(const Shape& shape, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d d = shape.rotation.back(direction), s = shape.size_m.cast<double>();
  Eigen::Vector3d p;
  if (shape.kind == Shape::Kind::ellipsoid) {
    const Eigen::Vector3d scaled = s.cwiseProduct(d);
    p = scaled.norm() > 0 ? Eigen::Vector3d(s.cwiseProduct(scaled.normalized())) : Eigen::Vector3d::Zero();
  } else {
    const Eigen::Vector2d azimuth = azimuth_of(d);
    const double across = d.head<2>().norm();
    const bool second = s[1] * across + s[2] * d.z() > s[0] * across;
    p << (second ? s[1] : s[0]) * azimuth, second ? s[2] : 0.0;
  }
  return shape.centre_m.cast<double>() + shape.rotation * p;
}

}  // namespace bpms
