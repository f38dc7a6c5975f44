#include "cases/pictures/canvas.h"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <pango/pangocairo.h>

#include <cmath>
#include <numbers>

#include "cases/pictures/colour.h"
#include "core/check.h"

#ifdef __SANITIZE_ADDRESS__
// Fontconfig keeps what it found until the process ends.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:libfontconfig"; }
#endif

namespace lahar::cases {

namespace {

// Shapes and widths of Helvetica, what journals print; the others stand in where it is absent.
constexpr const char* kFamilies = "Liberation Sans,Arial,Helvetica,DejaVu Sans,sans-serif";

// Of letters above and below the line: size, and the way up, as shares of the size of the others.
constexpr float kSmallLetters = 0.7F, kRaise = 0.36F, kLower = -0.16F;

struct Free {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
  void operator()(PangoFontDescription* font) const { pango_font_description_free(font); }
  void operator()(cairo_pattern_t* pattern) const { cairo_pattern_destroy(pattern); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};
template <class T>
using Owned = std::unique_ptr<T, Free>;

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

// Letters keep their true widths on every medium, so that a picture and a vector file have the same layout.
void use_true_widths(PangoLayout* layout) {
  PangoContext* context = pango_layout_get_context(layout);
  const Owned<cairo_font_options_t> options(cairo_font_options_create());
  cairo_font_options_set_antialias(options.get(), CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
  pango_cairo_context_set_font_options(context, options.get());
  pango_cairo_context_set_resolution(context, 72);
  pango_context_set_round_glyph_positions(context, FALSE);
}

void append_escaped(std::string& markup, const std::string& text, std::size_t& at) {
  const char c = text[at];
  const bool minus = c == '-' && at + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[at + 1])) != 0 &&
                     (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0);
  if (minus)
    markup += "\u2212";
  else if (c == '&')
    markup += "&amp;";
  else if (c == '<')
    markup += "&lt;";
  else if (c == '>')
    markup += "&gt;";
  else
    markup += c;
}

// (Pango's own <sup> takes its size from the wrong font where a layout is used more than once.)
std::string moved_span(float rise, float size) {
  const auto units = [](float length) { return std::to_string(std::lround(length * PANGO_SCALE)); };
  return "<span size=\"" + units(kSmallLetters * size) + "\" rise=\"" + units(rise * size) + "\">";
}

// Cairo numbers the surfaces of a process in this name.
void drop_number_of_surface(std::string& svg) {
  const std::string before = "<g id=\"surface";
  const std::size_t at = svg.find(before);
  if (at == std::string::npos) return;
  const std::size_t from = at + before.size();
  svg.erase(from, svg.find('"', from) - from);
}

}  // namespace

std::string text_markup(const std::string& text, float size) {
  std::string markup;
  bool open = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (!open && (text[at] == '^' || text[at] == '_') && at + 1 < text.size() && text[at + 1] == '{' &&
        text.find('}', at) != std::string::npos) {
      markup += moved_span(text[at] == '^' ? kRaise : kLower, size);
      open = true, ++at;
    } else if (open && text[at] == '}') {
      markup += "</span>";
      open = false;
    } else {
      append_escaped(markup, text, at);
    }
  }
  return markup;
}

struct Canvas::Parts {
  Medium medium;
  std::string bytes;  // of a vector file; outlives the surface that writes into it
  Owned<cairo_surface_t> surface;
  Owned<cairo_t> cairo;
  Owned<PangoLayout> layout;

  void colour(const Colour& c, double opacity) const {
    cairo_set_source_rgba(cairo.get(), static_cast<double>(c.x()), static_cast<double>(c.y()),
                          static_cast<double>(c.z()), opacity);
  }
  void path(std::span<const Point> points) const {
    for (const Point& p : points) cairo_line_to(cairo.get(), static_cast<double>(p.x()), static_cast<double>(p.y()));
  }
  void stroke(const Pen& pen) const {
    colour(pen.colour, 1);
    cairo_set_line_width(cairo.get(), static_cast<double>(pen.width));
    cairo_set_dash(cairo.get(), pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0);
    cairo_set_line_cap(cairo.get(), pen.dashes.empty() ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_stroke(cairo.get());
  }
  void fill(const Colour& c, float opacity, const Pen& rim) const {
    colour(c, static_cast<double>(opacity));
    cairo_fill_preserve(cairo.get());
    if (rim.width > 0) stroke(rim);
    cairo_new_path(cairo.get());
  }
  void set_text(const std::string& text, const Lettering& lettering) const {
    const Owned<PangoFontDescription> font(pango_font_description_new());
    pango_font_description_set_family_static(font.get(), kFamilies);
    pango_font_description_set_absolute_size(font.get(), std::round(static_cast<double>(lettering.size) * PANGO_SCALE));
    pango_font_description_set_weight(font.get(), lettering.bold ? PANGO_WEIGHT_BOLD : PANGO_WEIGHT_NORMAL);
    pango_layout_set_font_description(layout.get(), font.get());
    const std::string markup = text_markup(text, lettering.size);
    // Digits share one width but for pairs that are kerned, and a clock must not jitter.
    const bool numbers = text.find_first_of("0123456789") != std::string::npos;
    const char* const kerning = numbers ? "<span font_features=\"kern=0\">" : "<span>";
    pango_layout_set_markup(layout.get(), (kerning + markup + "</span>").c_str(), -1);
  }
};

Canvas::Canvas(Medium medium, float width, float height, float scale) : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  p.medium = medium;
  const auto w = static_cast<double>(width), h = static_cast<double>(height), s = static_cast<double>(scale);
  if (medium == Medium::svg)
    p.surface.reset(cairo_svg_surface_create_for_stream(append, &p.bytes, w, h));
  else if (medium == Medium::pdf)
    p.surface.reset(cairo_pdf_surface_create_for_stream(append, &p.bytes, w, h));
  else
    p.surface.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, static_cast<int>(std::lround(w * s)),
                                               static_cast<int>(std::lround(h * s))));
  if (medium == Medium::pdf) cairo_pdf_surface_set_metadata(p.surface.get(), CAIRO_PDF_METADATA_CREATE_DATE, nullptr);
  p.cairo.reset(cairo_create(p.surface.get()));
  require(cairo_status(p.cairo.get()) == CAIRO_STATUS_SUCCESS, "Canvas: cannot draw at this size");
  if (medium == Medium::pixels) cairo_scale(p.cairo.get(), s, s);
  cairo_set_line_join(p.cairo.get(), CAIRO_LINE_JOIN_ROUND);
  p.layout.reset(pango_cairo_create_layout(p.cairo.get()));
  use_true_widths(p.layout.get());
}

Canvas::~Canvas() = default;

void Canvas::line(std::span<const Point> points, const Pen& pen) {
  parts_->path(points);
  parts_->stroke(pen);
}

void Canvas::line(const Point& from, const Point& to, const Pen& pen) {
  const Point ends[2] = {from, to};
  line(ends, pen);
}

void Canvas::area(std::span<const Point> corners, const Colour& colour, float opacity, const Pen& rim) {
  parts_->path(corners);
  cairo_close_path(parts_->cairo.get());
  parts_->fill(colour, opacity, rim);
}

void Canvas::rectangle(const Point& upper_left, const Point& lower_right, const Colour& colour, float opacity,
                       float corner_radius) {
  const double x0 = static_cast<double>(upper_left.x()), y0 = static_cast<double>(upper_left.y());
  const double x1 = static_cast<double>(lower_right.x()), y1 = static_cast<double>(lower_right.y());
  const double r = static_cast<double>(corner_radius), quarter = std::numbers::pi / 2;
  cairo_t* cairo = parts_->cairo.get();
  if (r > 0) {
    cairo_arc(cairo, x1 - r, y0 + r, r, -quarter, 0);
    cairo_arc(cairo, x1 - r, y1 - r, r, 0, quarter);
    cairo_arc(cairo, x0 + r, y1 - r, r, quarter, 2 * quarter);
    cairo_arc(cairo, x0 + r, y0 + r, r, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo);
  } else {
    cairo_rectangle(cairo, x0, y0, x1 - x0, y1 - y0);
  }
  parts_->fill(colour, opacity, {.width = 0});
}

void Canvas::disc(const Point& centre, float radius, const Colour& colour, const Pen& rim) {
  cairo_arc(parts_->cairo.get(), static_cast<double>(centre.x()), static_cast<double>(centre.y()),
            static_cast<double>(radius), 0, 2 * std::numbers::pi);
  parts_->fill(colour, 1, rim);
}

void Canvas::colour_bar(const Point& upper_left, const Point& lower_right, std::span<const Colour> colours) {
  const Owned<cairo_pattern_t> ramp(
      cairo_pattern_create_linear(static_cast<double>(upper_left.x()), 0, static_cast<double>(lower_right.x()), 0));
  for (std::size_t n = 0; n < colours.size(); ++n)
    cairo_pattern_add_color_stop_rgb(ramp.get(), static_cast<double>(n) / static_cast<double>(colours.size() - 1),
                                     static_cast<double>(colours[n].x()), static_cast<double>(colours[n].y()),
                                     static_cast<double>(colours[n].z()));
  const Eigen::Vector2d from = upper_left.cast<double>(), size = lower_right.cast<double>() - from;
  cairo_set_source(parts_->cairo.get(), ramp.get());
  cairo_rectangle(parts_->cairo.get(), from.x(), from.y(), size.x(), size.y());
  cairo_fill(parts_->cairo.get());
}

void Canvas::text(const Point& at, const std::string& text, const Lettering& lettering, Hold hold, float degrees) {
  const float back = hold == Hold::start ? 0 : (hold == Hold::middle ? 0.5F : 1.0F) * text_width(text, lettering);
  parts_->set_text(text, lettering);
  cairo_t* cairo = parts_->cairo.get();
  cairo_save(cairo);
  cairo_translate(cairo, static_cast<double>(at.x()), static_cast<double>(at.y()));
  cairo_rotate(cairo, -std::numbers::pi / 180 * static_cast<double>(degrees));
  cairo_move_to(cairo, -static_cast<double>(back), 0);
  parts_->colour(lettering.colour, 1);
  pango_cairo_show_layout_line(cairo, pango_layout_get_line_readonly(parts_->layout.get(), 0));
  cairo_restore(cairo);
  cairo_new_path(cairo);
}

float Canvas::text_width(const std::string& text, const Lettering& lettering) {
  if (text.empty()) return 0;
  parts_->set_text(text, lettering);
  PangoRectangle box;
  pango_layout_get_extents(parts_->layout.get(), nullptr, &box);
  return static_cast<float>(box.width) / PANGO_SCALE;
}

void Canvas::clip(const Point& upper_left, const Point& lower_right) {
  const Eigen::Vector2d from = upper_left.cast<double>(), size = lower_right.cast<double>() - from;
  cairo_save(parts_->cairo.get());
  cairo_rectangle(parts_->cairo.get(), from.x(), from.y(), size.x(), size.y());
  cairo_clip(parts_->cairo.get());
}

void Canvas::unclip() { cairo_restore(parts_->cairo.get()); }

void Canvas::lay_over(Image& image) {
  cairo_surface_t* surface = parts_->surface.get();
  require(parts_->medium == Medium::pixels && cairo_image_surface_get_width(surface) == image.width() &&
              cairo_image_surface_get_height(surface) == image.height(),
          "Canvas: the picture has another size");
  cairo_surface_flush(surface);
  const unsigned char* bytes = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const unsigned char* row = bytes + static_cast<std::ptrdiff_t>(y) * stride;
      const std::uint32_t argb = reinterpret_cast<const std::uint32_t*>(row)[x];  // colours times opacity
      if (argb >> 24 == 0) continue;
      image.at(x, y) = from_hex(argb & 0xffffffU) + (1 - static_cast<float>(argb >> 24) / 255.0F) * image.at(x, y);
    }
}

std::string Canvas::document() {
  require(parts_->medium != Medium::pixels, "Canvas: pixels are no vector file");
  parts_->layout.reset();
  parts_->cairo.reset();
  cairo_surface_finish(parts_->surface.get());
  require(cairo_surface_status(parts_->surface.get()) == CAIRO_STATUS_SUCCESS, "Canvas: the drawing failed");
  if (parts_->medium == Medium::svg) drop_number_of_surface(parts_->bytes);
  return parts_->bytes;
}

}  // namespace lahar::cases
