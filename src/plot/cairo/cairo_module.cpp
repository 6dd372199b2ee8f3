// SPDX-License-Identifier: Apache-2.0
#include <cairo-pdf.h>
#include <cairo.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "src/plot/pdf_module.h"

namespace skein {
namespace {

constexpr double kHaloPerSize = 0.3;
constexpr double kTurn = 6.283185307179586;
constexpr const char* kFont = "Helvetica";  // or what fontconfig has in its place

cairo_status_t Append(void* file, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

void SetColour(cairo_t* cairo, Colour colour, double opacity = 1) {
  const auto share = [colour](int shift) { return ((colour >> shift) & 0xFF) / 255.0; };
  cairo_set_source_rgba(cairo, share(16), share(8), share(0), opacity);
}

/// Fills and strokes what the path of `cairo` encloses.
void Paint(cairo_t* cairo, const std::optional<Colour>& fill, const std::optional<Colour>& stroke,
           double width, double opacity) {
  if (fill) {
    SetColour(cairo, *fill, opacity);
    cairo_fill_preserve(cairo);
  }
  if (stroke) {
    SetColour(cairo, *stroke, opacity);
    cairo_set_line_width(cairo, width);
    cairo_stroke_preserve(cairo);
  }
  cairo_new_path(cairo);
}

void SetDash(cairo_t* cairo, Dash dash) {
  constexpr double kLong[] = {4.5, 3}, kShort[] = {1.5, 2};
  cairo_set_dash(cairo, dash == Dash::kShort ? kShort : kLong, dash == Dash::kNone ? 0 : 2, 0);
}

struct ShapePainter {
  cairo_t* cairo;

  void operator()(const Path& path) const {
    if (path.points.empty()) return;
    for (const PagePoint& point : path.points) cairo_line_to(cairo, point.x, point.y);
    if (path.is_closed) cairo_close_path(cairo);
    SetDash(cairo, path.dash);
    Paint(cairo, path.fill, path.stroke, path.width, path.opacity);
  }

  void operator()(const Disc& disc) const {
    cairo_arc(cairo, disc.middle.x, disc.middle.y, disc.radius, 0, kTurn);
    SetDash(cairo, Dash::kNone);
    Paint(cairo, disc.fill, disc.stroke, disc.width, 1);
  }

  void operator()(const Words& words) const {
    cairo_select_font_face(cairo, kFont, CAIRO_FONT_SLANT_NORMAL,
                           words.is_bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(cairo, words.size);
    cairo_text_extents_t extents;
    cairo_text_extents(cairo, words.text.c_str(), &extents);
    const double before = words.anchor == Anchor::kStart    ? 0
                          : words.anchor == Anchor::kMiddle ? extents.x_advance / 2
                                                            : extents.x_advance;
    cairo_save(cairo);
    cairo_translate(cairo, words.at.x, words.at.y);
    if (words.runs_upwards) cairo_rotate(cairo, -kTurn / 4);
    if (words.has_halo) {
      cairo_move_to(cairo, -before, 0);
      cairo_text_path(cairo, words.text.c_str());
      SetDash(cairo, Dash::kNone);
      Paint(cairo, std::nullopt, kWhite, kHaloPerSize * words.size, 1);
    }
    cairo_move_to(cairo, -before, 0);
    SetColour(cairo, words.colour);
    cairo_show_text(cairo, words.text.c_str());
    cairo_new_path(cairo);
    cairo_restore(cairo);
  }
};

class CairoModule : public PdfModule {
 public:
  bool Write(const Picture& picture, std::string* file) const override {
    cairo_surface_t* const surface =
        cairo_pdf_surface_create_for_stream(Append, file, picture.width, picture.height);
    // Later versions of the format keep objects in compressed streams, which not all programs read.
    cairo_pdf_surface_restrict_to_version(surface, CAIRO_PDF_VERSION_1_4);
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, picture.title.c_str());
    // Without the time of day the same picture is the same file.
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
    cairo_t* const cairo = cairo_create(surface);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (const Shape& shape : picture.shapes) std::visit(ShapePainter{cairo}, shape);
    cairo_show_page(cairo);
    cairo_status_t status = cairo_status(cairo);
    cairo_destroy(cairo);
    cairo_surface_finish(surface);
    if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
    cairo_surface_destroy(surface);
    if (status != CAIRO_STATUS_SUCCESS) *file = cairo_status_to_string(status);
    return status == CAIRO_STATUS_SUCCESS;
  }
};

}  // namespace
}  // namespace skein

extern "C" {
__attribute__((visibility("default"))) const skein::PdfModule* skein_pdf_module(const char* build) {
  static const skein::CairoModule module;
  return build == std::string_view(SKEIN_BUILD_ID) ? &module : nullptr;
}
}
