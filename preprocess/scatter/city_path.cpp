// Closed rectangles with round corners along the middles of streets, and a circle.
#include "scatter/city_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace jalousie::scatter {
namespace {

constexpr double kEyeLevel = 0.9;      ///< of a walker, units
constexpr double kSeatLevel = 1.2;     ///< of a driver
constexpr double kWalkCorner = 3.0;    ///< radius of the corners, units; the street is wide enough for both
constexpr double kDriveCorner = 6.0;   ///< passes the corner of a block at 1.7 units
constexpr double kLookAbout = 0.45;    ///< a walker's largest angle from the way, radians
constexpr double kLooks = 6.0;         ///< to and fro on the whole way
constexpr double kFlightHeight = 1.4;  ///< in highest roofs
constexpr double kFlightRadius = 0.3;  ///< in sides of the city
constexpr double kFlightDown = 0.4;    ///< radians
constexpr double kFlightInward = 0.5;  ///< towards the middle, radians

/// A rectangle with round corners, run through clockwise as seen from above.
class Round {
 public:
  /// @param low, high  streets along which it runs   @param radius  of the corners, world units
  Round(const City& city, std::uint32_t low, std::uint32_t high, double radius)
      : half_(0.5 * double{city.streetAt(high) - city.streetAt(low)}),
        middle_(0.5 * double{city.streetAt(high) + city.streetAt(low)}),
        radius_(radius) {}

  struct Place {
    glm::dvec2 position;
    glm::dvec2 direction;  ///< unit
  };
  /// @param turn  0 to 1
  Place at(double turn) const {
    const double straight = 2.0 * (half_ - radius_);
    const double arc = 0.5 * std::numbers::pi * radius_;
    const double way = 4.0 * (turn - std::floor(turn));
    const double quarter = std::min(std::floor(way), 3.0);
    const double along = (way - quarter) * (straight + arc);
    Place place{{-half_ + radius_ + along, -half_}, {1.0, 0.0}};
    if (along > straight) {
      const double angle = (along - straight) / radius_;
      place = {{half_ - radius_ + radius_ * std::sin(angle), -half_ + radius_ - radius_ * std::cos(angle)},
               {std::cos(angle), std::sin(angle)}};
    }
    for (int i = 0; i < static_cast<int>(quarter); ++i)
      place = {{-place.position.y, place.position.x}, {-place.direction.y, place.direction.x}};
    place.position += middle_;
    return place;
  }

 private:
  double half_;
  double middle_;
  double radius_;
};

double turnAt(double frame) {
  return frame / (kFrameCount - 1);
}

CameraPath streetPath(const City& city, const Round& way, double level, double lookAbout) {
  return sampledPath([&](double frame) {
    const Round::Place place = way.at(turnAt(frame));
    const double angle = lookAbout * std::sin(2.0 * std::numbers::pi * kLooks * turnAt(frame));
    const glm::dvec2& ahead = place.direction;
    return CameraPose{{place.position.x, level * double{city.unit}, place.position.y},
                      {ahead.x * std::cos(angle) - ahead.y * std::sin(angle), 0.0,
                       ahead.x * std::sin(angle) + ahead.y * std::cos(angle)}};
  });
}

CameraPath flightPath(const City& city) {
  return sampledPath([&](double frame) {
    const double angle = 2.0 * std::numbers::pi * turnAt(frame);
    const double radius = kFlightRadius * double{city.side()};
    const double heading = angle + kFlightInward;
    return CameraPose{
        {radius * std::cos(angle), kFlightHeight * double{kHighestRoof * city.unit}, radius * std::sin(angle)},
        {-std::sin(heading) * std::cos(kFlightDown), -std::sin(kFlightDown),
         std::cos(heading) * std::cos(kFlightDown)}};
  });
}

}  // namespace

std::vector<CityPath> cityPaths(const City& city) {
  const std::uint32_t middle = city.blocks / 2;
  const auto unit = static_cast<double>(city.unit);
  const Round walk(city, middle, middle + 1, kWalkCorner * unit);
  const Round drive(city, middle - std::min(middle, 2U), std::min(middle + 2, city.blocks), kDriveCorner * unit);
  return {{"walk", streetPath(city, walk, kEyeLevel, kLookAbout)},
          {"flight", flightPath(city)},
          {"drive", streetPath(city, drive, kSeatLevel, 0.0)}};
}

}  // namespace jalousie::scatter
