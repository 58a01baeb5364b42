// SPDX-License-Identifier: BSD-3-Clause
/// bed.csv of a coupled run: what the bed does, a row every sample_interval.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "core/Case.hpp"
#include "engine/BedMonitors.hpp"
#include "engine/CoupledEngine.hpp"
#include "gimdem/coupling/Server.hpp"
#include "output/TimeSeries.hpp"

namespace gimdem::app
{

class BedSeries
{
public:
    /// Throws UserError if [output] names a patch that the mesh has not.
    BedSeries(Case const& settings, PolyMesh const& mesh, DemSystem const& system);

    /// Before the first row: the client's monitors are columns too.
    void open(std::filesystem::path const& file, coupling::FluidState const& fluid);
    /// Before a step.
    void write_row(coupling::FluidState const& fluid, CoupledEngine const& engine);
    /// After a step that stands, with its pressure drop [Pa].
    void add(coupling::Step const& step, StepReport const& report, double pressure_drop);
    /// The run goes on from an earlier time [s], as the particles do. Returns how many rows are left.
    std::int64_t rewind(double time);
    double pressure_drop(coupling::FluidFields const& fluid) const;  ///< [Pa], 0 where it is not asked for

    /// The cells whose pressure and gradients are read in every step.
    std::vector<std::int32_t> monitored_cells() const;
    bool is_open() const { return series_.has_value(); }

    /// Null if the case names none.
    coupling::Patch const* inlet() const { return inlet_; }

private:
    /// Sums since the last row.
    struct Interval
    {
        double duration = 0;
        Vec3 drag = Vec3::Zero(), pressure = Vec3::Zero(), wall = Vec3::Zero();  ///< impulses [N s]
        double pressure_drop = 0;                                                ///< time integral [Pa s]
        double volume_imbalance = 0, momentum_imbalance = 0;                     ///< worst
        std::int64_t clips = 0;
    };

    bool has_pressure_drop() const { return inlet_ != nullptr && outlet_ != nullptr; }

    Case const& settings_;
    PolyMesh const& mesh_;
    DemSystem const& system_;
    Vec3 up_;
    std::vector<PlaneSection> planes_;
    coupling::Patch const* inlet_ = nullptr;
    coupling::Patch const* outlet_ = nullptr;
    std::optional<output::TimeSeries> series_;
    Interval interval_;
    Vec3 last_momentum_ = Vec3::Zero();
};

/// The same numbers, as the output takes them.
std::span<double const> as_span(coupling::Span<double const> values);

}  // namespace gimdem::app
