// SPDX-License-Identifier: BSD-3-Clause
#include "output/Progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "output/Text.hpp"

namespace gimdem::output
{

namespace
{

using namespace std::chrono_literals;

constexpr auto terminal_interval = 200ms;
constexpr auto log_interval = 10s;

template <class... Values>
std::string formatted(char const* format, Values... values)
{
    char buffer[128];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

/// `  text`, or nothing where the value is unknown.
std::string part(char const* format, double value)
{
    return std::isnan(value) ? "" : "  " + formatted(format, value);
}

std::string text_of(ProgressSample const& sample, double wall_seconds, double simulated)
{
    double const wall_per_simulated = simulated > 0 ? wall_seconds / simulated : NAN;
    std::string line = formatted("t = %.4f of %g s", sample.time, sample.until);
    if (simulated > 0) line += "  left " + duration_text((sample.until - sample.time) * wall_per_simulated);
    line += part("DEM %.1f ms", sample.dem_ms) + part("CFD %.1f ms", sample.cfd_ms);
    line += part("void fraction %.3f", sample.void_fraction_min);
    if (!std::isnan(sample.void_fraction_max)) line += formatted("..%.3f", sample.void_fraction_max);
    line += part("Co %.2f", sample.courant) + part("fastest %.2f m/s", sample.speed_max);
    return line + part("%.3g s per simulated s", wall_per_simulated);
}

std::string text_of(SettlingSample const& sample, double wall_seconds, double simulated)
{
    std::string line = formatted("settling bed: t = %.4f of at most %g s", sample.time, sample.until);
    line += part("mean kinetic energy %.2e J", sample.kinetic_energy);
    if (sample.target > 0) line += formatted(" (settled below %.0e J)", sample.target);
    if (simulated > 0)
        line += "  left at most " + duration_text((sample.until - sample.time) * wall_seconds / simulated);
    return line;
}

/// Characters that fit into one line of the terminal; a longer line could not be rewritten.
std::size_t columns_of(std::FILE* stream)
{
    winsize size{};
    if (::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 1) return size.ws_col - 1u;
    return std::string::npos;
}

}  // namespace

Progress::Progress()
    : Progress(stderr, ::isatty(::fileno(stderr)) == 1, [] { return std::chrono::steady_clock::now(); })
{
}

Progress::Progress(std::FILE* stream, bool is_terminal, Clock clock)
    : stream_(stream), is_terminal_(is_terminal), clock_(std::move(clock))
{
}

Progress::~Progress()
{
    finish();
}

void Progress::show(ProgressSample const& sample)
{
    show_sample(sample, sample.time);
}
void Progress::show(SettlingSample const& sample)
{
    show_sample(sample, sample.time);
}

void Progress::show_sample(Sample const& sample, double time)
{
    if (last_.index() != sample.index()) finish();
    bool const is_first = std::holds_alternative<std::monostate>(last_);
    Time const now = clock_();
    if (is_first)
    {
        phase_start_ = now;
        phase_start_time_ = time;
    }
    last_ = sample;
    is_last_shown_ = is_first || now - last_print_ >= (is_terminal_ ? Time::duration(terminal_interval) : log_interval);
    if (!is_last_shown_) return;
    last_print_ = now;
    print(line_of(last_));
}

std::string Progress::line_of(Sample const& sample) const
{
    double const wall = std::chrono::duration<double>(clock_() - phase_start_).count();
    if (auto const* settling = std::get_if<SettlingSample>(&sample))
        return text_of(*settling, wall, settling->time - phase_start_time_);
    auto const& running = std::get<ProgressSample>(sample);
    return text_of(running, wall, running.time - phase_start_time_);
}

void Progress::print(std::string const& line)
{
    if (is_terminal_)
    {
        std::string const shown = line.substr(0, columns_of(stream_));
        std::size_t const rest = width_ > shown.size() ? width_ - shown.size() : 0;
        std::fprintf(stream_, "\r%s%*s", shown.c_str(), static_cast<int>(rest), "");
        width_ = shown.size();
    }
    else
        std::fprintf(stream_, "%s\n", line.c_str());
    std::fflush(stream_);
}

void Progress::clear()
{
    if (width_ == 0) return;
    std::fprintf(stream_, "\r%*s\r", static_cast<int>(width_), "");
    std::fflush(stream_);
    width_ = 0;
    last_print_ = {};
}

void Progress::finish()
{
    if (std::holds_alternative<std::monostate>(last_)) return;
    if (!is_last_shown_ || (is_terminal_ && width_ == 0)) print(line_of(last_));
    if (is_terminal_) std::fprintf(stream_, "\n");
    std::fflush(stream_);
    width_ = 0;
    last_ = {};
}

}  // namespace gimdem::output
