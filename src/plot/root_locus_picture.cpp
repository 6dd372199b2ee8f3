// SPDX-License-Identifier: Apache-2.0
#include "src/plot/root_locus_picture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/number_text.h"
#include "src/plot/axes.h"
#include "src/plot/legend.h"

namespace skein {
namespace {

constexpr double kLeft = 40, kHeightPerWidth = 0.9;
constexpr double kPointsPerTick = 46, kHeightPerTick = 24;
constexpr double kRadius = 2, kPale = 0.75;
constexpr double kSlow = 0.5;  // 1/s: what the second panel shows

class LocusDrawing {
 public:
  LocusDrawing(const std::vector<LinearisedFlight>& flights, double width)
      : flights_(flights), width_(width) {
    for (const LinearisedFlight& flight : flights) {
      for (const FlightMode& mode : flight.modes) {
        const std::string name = mode.name.substr(0, mode.name.find(','));
        colours_.emplace(name, ColourOf(colours_.size()));
      }
    }
  }

  Picture Draw(const std::string& title) {
    const double top = DrawTitle(title, width_, &shapes_) + 8;
    const double panel_width = (width_ - 2 * kLeft - kMargin) / 2;
    DrawPanel({kLeft, top}, panel_width, INFINITY);
    DrawPanel({2 * kLeft + panel_width, top}, panel_width, kSlow);
    std::vector<LegendEntry> entries;
    for (const auto& [name, colour] : colours_) {
      entries.push_back({[colour = colour](PagePoint left, std::vector<Shape>* shapes) {
                           const PagePoint middle{left.x + kSampleWidth / 2, left.y};
                           shapes->emplace_back(Disc{middle, kRadius, colour, std::nullopt});
                         },
                         name});
    }
    const double bottom = DrawLegend({kLeft, top + kHeightPerWidth * panel_width + 40},
                                     width_ - kMargin, entries, &shapes_);
    return FinishedPicture(width_, bottom, title.empty() ? "Root locus" : title,
                           std::move(shapes_));
  }

 private:
  void DrawPanel(PagePoint corner, double width, double fastest) {
    std::vector<double> real = {0}, imaginary = {0};
    for (const LinearisedFlight& flight : flights_) {
      for (const FlightMode& mode : flight.modes) {
        if (mode.frequency_rad_s() > fastest) continue;
        real.push_back(mode.eigenvalue.real());
        imaginary.push_back(mode.eigenvalue.imag());
      }
    }
    const Panel panel(corner, width, kHeightPerWidth * width, Padded(real), Padded(imaginary));
    const auto across = Ticks(panel.x_range(), panel.width() / kPointsPerTick);
    const auto up = Ticks(panel.y_range(), (panel.bottom() - panel.top()) / kHeightPerTick);
    panel.DrawGrid(across, up, &shapes_);
    panel.LabelLeft(up, &shapes_);
    panel.LabelBottom(across, &shapes_);
    panel.DrawCurve({{0, panel.y_range().min}, {0, panel.y_range().max}}, kInk, 0.8, Dash::kNone,
                    &shapes_);
    shapes_.emplace_back(Words{{panel.left() + panel.width() / 2, panel.bottom() + 22},
                               "real part, 1/s; upwards imaginary part",
                               kTextSize,
                               Anchor::kMiddle});
    for (std::size_t i = 0; i < flights_.size(); ++i) DrawModes(panel, i, fastest);
  }

  void DrawModes(const Panel& panel, std::size_t flight, double fastest) {
    const double share =
        flights_.size() > 1 ? static_cast<double>(flight) / static_cast<double>(flights_.size() - 1)
                            : 1;
    for (const FlightMode& mode : flights_[flight].modes) {
      if (mode.frequency_rad_s() > fastest) continue;
      const Colour colour = colours_.at(mode.name.substr(0, mode.name.find(',')));
      shapes_.emplace_back(Disc{panel.Place(mode.eigenvalue.real(), mode.eigenvalue.imag()),
                                kRadius, Mixed(colour, kWhite, kPale * (1 - share)), std::nullopt});
    }
  }

  const std::vector<LinearisedFlight>& flights_;
  double width_;
  std::map<std::string, Colour> colours_;
  std::vector<Shape> shapes_;
};

}  // namespace

Picture DrawRootLocus(const std::vector<LinearisedFlight>& flights, double width,
                      const std::string& title) {
  return LocusDrawing(flights, width).Draw(title);
}

}  // namespace skein
