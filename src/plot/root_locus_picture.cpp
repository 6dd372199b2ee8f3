// SPDX-License-Identifier: Apache-2.0
#include "src/plot/root_locus_picture.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/number_text.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kHeightPerWidth = 0.9;
constexpr double kRadius = 2, kPale = 0.5;
constexpr std::size_t kMostMarkers = 2 * kMarkers.size();  // full, then hollow

bool IsAnyMode(const FlightMode&) { return true; }

/// Of the modes that are far slower than the others.
bool IsPhugoidOrSpiral(const FlightMode& mode) {
  return mode.family == ModeFamily::kPhugoid || mode.family == ModeFamily::kSpiral;
}

/// "short period" of "short period, real".
std::string NameOf(const FlightMode& mode) { return mode.name.substr(0, mode.name.find(',')); }

/// The same in every picture, of each of the names that FindFlightModes gives. The colours are of
/// Okabe and Ito (2008): more than all can tell apart, but where a mode lies says which it is, too.
Colour ColourOfMode(const std::string& name) {
  static const std::map<std::string, Colour> colours = {
      {"short period", 0x0072B2}, {"phugoid", 0xD55E00}, {"Dutch roll", 0x009E73},
      {"roll", 0xCC79A7},         {"spiral", 0xE69F00},  {"third oscillatory", 0x56B4E9},
      {"roll-spiral", kInk}};
  return colours.at(name);
}

class LocusDrawing {
 public:
  LocusDrawing(const std::vector<LinearisedFlight>& flights, double width)
      : flights_(flights), width_(width) {
    std::vector<double> speeds;
    for (const LinearisedFlight& flight : flights) {
      speeds.push_back(flight.request.true_airspeed_ft_s);
      altitudes_.emplace(flight.request.altitude_ft, 0);
      for (const FlightMode& mode : flight.modes) {
        names_.insert(NameOf(mode));
      }
    }
    speeds_ = SpanOf(speeds);
    std::size_t index = 0;
    for (auto& [altitude, number] : altitudes_) number = index++;
  }

  Picture Draw(const std::string& title) {
    const double top = DrawTitle(title, width_, &shapes_) + kAbovePanel;
    const double panel_width = (width_ - 2 * kLeftOfPanel - kMargin) / 2;
    DrawPanel("all modes", {kLeftOfPanel, top}, panel_width, IsAnyMode);
    DrawPanel("phugoid and spiral, enlarged", {2 * kLeftOfPanel + panel_width, top}, panel_width,
              IsPhugoidOrSpiral);
    const double bottom = DrawLegend({kLeftOfPanel, top + kHeightPerWidth * panel_width + 40},
                                     width_ - kMargin, Entries(), &shapes_);
    return FinishedPicture(width_, bottom, title.empty() ? "Root locus" : title,
                           std::move(shapes_));
  }

 private:
  using ModeFilter = bool (*)(const FlightMode&);

  void DrawPanel(const std::string& head, PagePoint corner, double width, ModeFilter is_shown) {
    std::vector<double> real = {0}, imaginary = {0};
    for (const LinearisedFlight& flight : flights_) {
      for (const FlightMode& mode : flight.modes) {
        if (!is_shown(mode)) continue;
        real.push_back(mode.eigenvalue.real());
        imaginary.push_back(mode.eigenvalue.imag());
      }
    }
    const Panel panel(corner, width, kHeightPerWidth * width, Padded(real), Padded(imaginary));
    panel.DrawAxes(&shapes_);
    panel.DrawCurve({{0, panel.y_range().min}, {0, panel.y_range().max}}, kInk, 0.8, Dash::kNone,
                    &shapes_);
    panel.DrawHead(head, &shapes_);
    panel.NameLeft("imaginary part, rad/s", &shapes_);
    panel.NameBottom("real part, 1/s", &shapes_);
    for (const LinearisedFlight& flight : flights_) DrawModes(panel, flight, is_shown);
  }

  void DrawModes(const Panel& panel, const LinearisedFlight& flight, ModeFilter is_shown) {
    const double width = speeds_.max - speeds_.min;
    const double share = width > 0 ? (flight.request.true_airspeed_ft_s - speeds_.min) / width : 1;
    const std::size_t altitude = altitudes_.at(flight.request.altitude_ft);
    for (const FlightMode& mode : flight.modes) {
      if (!is_shown(mode)) continue;
      const Colour colour = ColourOfMode(NameOf(mode));
      shapes_.push_back(MarkerAt(panel.Place(mode.eigenvalue.real(), mode.eigenvalue.imag()),
                                 MarkerOf(altitude),
                                 LookOf(altitude, Mixed(colour, kWhite, kPale * (1 - share)))));
    }
  }

  /// Whether each altitude has a marker of its own.
  bool HasMarkers() const { return altitudes_.size() > 1 && altitudes_.size() <= kMostMarkers; }
  Marker MarkerOf(std::size_t altitude) const {
    return HasMarkers() ? kMarkers[altitude % kMarkers.size()] : Marker::kDisc;
  }
  Disc LookOf(std::size_t altitude, Colour colour) const {
    const bool is_hollow = HasMarkers() && altitude >= kMarkers.size();
    return is_hollow ? Disc{{}, kRadius, kWhite, colour, 0.8}
                     : Disc{{}, kRadius, colour, std::nullopt};
  }

  std::vector<LegendEntry> Entries() const {
    std::vector<LegendEntry> entries;
    for (const std::string& name : names_) {
      entries.push_back({MarkerSample(Marker::kDisc, LookOf(0, ColourOfMode(name))), name});
    }
    if (speeds_.max > speeds_.min) {
      entries.push_back(PaleIsSlow(speeds_, kRadius, kPale));
    }
    for (const auto& [altitude, number] : altitudes_) {
      if (!HasMarkers()) break;
      entries.push_back(
          {MarkerSample(MarkerOf(number), LookOf(number, kInk)), TickText(altitude) + " ft"});
    }
    return entries;
  }

  const std::vector<LinearisedFlight>& flights_;
  double width_;
  Range speeds_;
  std::map<double, std::size_t> altitudes_;  ///< and their numbers, from below
  std::set<std::string> names_;              ///< of the modes that there are
  std::vector<Shape> shapes_;
};

}  // namespace

Picture DrawRootLocus(const std::vector<LinearisedFlight>& flights, double width,
                      const std::string& title) {
  return LocusDrawing(flights, width).Draw(title);
}

}  // namespace skein
