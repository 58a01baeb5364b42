// SPDX-License-Identifier: BSD-3-Clause
/// One live line that tells how far a run is.
#pragma once

#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <variant>

namespace gimdem::output
{

/// State of a coupled run after a step. A NaN is left out of the line.
struct ProgressSample
{
    double time = 0;               ///< simulated [s]
    double until = 0;              ///< end of the simulation [s]
    double dem_ms = 0;             ///< wall time of the DEM side per coupling step [ms]
    double cfd_ms = 0;             ///< wall time of the CFD side per coupling step [ms]
    double void_fraction_min = 0;  ///< over all cells [1]
    double void_fraction_max = 0;  ///< over all cells [1]
    double courant = 0;            ///< largest Courant number of the fluid [1]
    double speed_max = 0;          ///< of the fastest particle [m/s]
};

/// State of a bed that settles.
struct SettlingSample
{
    double time = 0;            ///< simulated [s]
    double until = 0;           ///< given up then [s]
    double kinetic_energy = 0;  ///< mean per particle [J]
    double target = 0;          ///< settled below this mean kinetic energy [J]; 0: none
};

/// Shows samples on a terminal as one line that is rewritten at most five times a second, and elsewhere (a log file)
/// as a line every ten seconds. The first sample of a phase always shows.
class Progress
{
public:
    using Clock = std::function<std::chrono::steady_clock::time_point()>;

    Progress();  ///< to stderr, a terminal if it is one
    Progress(std::FILE* stream, bool is_terminal, Clock clock);
    ~Progress();  ///< as finish()
    Progress(Progress const&) = delete;
    Progress& operator=(Progress const&) = delete;

    /// Show one sample. Cheap where nothing is due; the wall time left is estimated from the samples so far.
    void show(ProgressSample const& sample);
    void show(SettlingSample const& sample);

    /// Remove the line so that something else can be printed; the next show() puts it back.
    void clear();

    /// End of a phase: show its last sample and leave it standing.
    void finish();

private:
    using Time = std::chrono::steady_clock::time_point;
    using Sample = std::variant<std::monostate, ProgressSample, SettlingSample>;

    void show_sample(Sample const& sample, double time);
    std::string line_of(Sample const& sample) const;
    void print(std::string const& line);

    std::FILE* stream_;
    bool is_terminal_;
    Clock clock_;
    Sample last_;  ///< of this phase; none before its first
    bool is_last_shown_ = false;
    Time phase_start_{};
    double phase_start_time_ = 0;  ///< simulated time of the first sample [s]
    Time last_print_{};
    std::size_t width_ = 0;  ///< characters that the line on the terminal has now
};

}  // namespace gimdem::output
