// Pictures for the generators of this folder: kept in double, written as PNG of 8 bits.
#pragma once

#include <png.h>

#include <algorithm>
#include <array>
#include <functional>

#include "make_common.h"

struct Rgb {
    double r = 0, g = 0, b = 0;
};
inline Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator*(Rgb a, double s) { return {a.r * s, a.g * s, a.b * s}; }
inline Rgb blend(Rgb a, Rgb b, double t) { return a * (1 - t) + b * t; }

// A picture of 1 to 4 channels in [0, 1], as it stands in the file: colours are sRGB.
struct Picture {
    int width, height, channels;
    std::vector<double> values;

    Picture(int w, int h, int c)
        : width(w),
          height(h),
          channels(c),
          values(static_cast<size_t>(w) * static_cast<size_t>(h) * static_cast<size_t>(c))
    {
    }
    double& at(int x, int y, int c)
    {
        return values[(static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
                          static_cast<size_t>(channels) +
                      static_cast<size_t>(c)];
    }
    void set(int x, int y, Rgb c) { at(x, y, 0) = c.r, at(x, y, 1) = c.g, at(x, y, 2) = c.b; }
};

[[noreturn]] inline void fail(const std::string& path)
{
    std::fprintf(stderr, "cannot write %s\n", path.c_str());
    std::exit(1);
}

// `levels` below 256 makes files of noise a good deal smaller and cannot be seen.
inline void write_png(const std::string& path, Picture& p, int levels = 256)
{
    std::vector<png_byte> bytes;
    for (const double v : p.values) {
        const double step = std::round(std::clamp(v, 0.0, 1.0) * (levels - 1)) / (levels - 1);
        bytes.push_back(static_cast<png_byte>(std::lround(255 * step)));
    }
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file) fail(path);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png))) fail(path);
    png_init_io(png, file);
    constexpr std::array<int, 5> types = {0, PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                          PNG_COLOR_TYPE_RGB_ALPHA};
    png_set_IHDR(png, info, static_cast<png_uint_32>(p.width), static_cast<png_uint_32>(p.height), 8,
                 types[static_cast<size_t>(p.channels)], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png, 9);
    if (levels < 256) png_set_filter(png, 0, PNG_FILTER_NONE | PNG_FILTER_SUB | PNG_FILTER_UP);
    png_write_info(png, info);
    for (int y = 0; y < p.height; ++y)
        png_write_row(png, &bytes[static_cast<size_t>(y) * static_cast<size_t>(p.width * p.channels)]);
    png_write_end(png, nullptr);
    png_destroy_write_struct(&png, &info);
    if (std::fclose(file) != 0) fail(path);
}

// Fills a picture of one channel with value(u, v), both in [0, 1), v upwards.
inline void write_grey(const std::string& path, int width, int height, int levels,
                       const std::function<double(double, double)>& value)
{
    Picture p(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p.at(x, y, 0) = value((x + 0.5) / width, 1 - (y + 0.5) / height);
    write_png(path, p, levels);
}
inline void write_color(const std::string& path, int width, int height, int levels,
                        const std::function<Rgb(double, double)>& value)
{
    Picture p(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) p.set(x, y, value((x + 0.5) / width, 1 - (y + 0.5) / height));
    write_png(path, p, levels);
}

// Mean over 3 x 3 places of each pixel. `paint` gets places in [0, 1], y upwards, and says whether anything is there.
inline Picture cut_out(int width, int height, Rgb behind, const std::function<bool(double, double, Rgb&)>& paint)
{
    Picture p(width, height, 4);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Rgb sum;
            int found = 0;
            for (int k = 0; k < 9; ++k) {
                Rgb c;
                if (!paint((x + (k % 3 + 0.5) / 3) / width, 1 - (y + (k / 3 + 0.5) / 3) / height, c)) continue;
                sum = sum + c;
                ++found;
            }
            p.set(x, y, found ? sum * (1.0 / found) : behind);  // what is cut away has a leaf's colour, not black
            p.at(x, y, 3) = found / 9.0;
        }
    return p;
}
