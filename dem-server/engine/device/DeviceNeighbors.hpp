// SPDX-License-Identifier: BSD-3-Clause
/// The neighbour search on a device: the same list as NeighborSearch makes, by the same kernels.
#pragma once

#include <cstdint>
#include <type_traits>
#include <utility>

#include "contact/PairwiseKernels.hpp"
#include "engine/device/DeviceParticles.hpp"
#include "engine/device/MotionKernels.hpp"
#include "exec/device/DeviceReduce.hpp"
#include "exec/device/DeviceSort.hpp"
#include "search/CandidateVisitor.hpp"
#include "search/NeighborList.hpp"
#include "search/PairListKernels.hpp"
#include "search/PairSprings.hpp"

namespace gimdem
{

/// Moves particles into the periodic box.
struct WrapKernel
{
    Quad* position;
    Domain domain;

    GIMDEM_HD void operator()(std::int64_t i) const { position[i].set_xyz(domain.wrap(position[i].xyz())); }
};

struct CellKernel
{
    Quad const* position;
    SizeLevels levels;
    std::int32_t* cell_of;

    GIMDEM_HD void operator()(std::int64_t i) const { cell_of[i] = levels.cell_of(position[i]); }
};

template <class T>
struct FillKernel
{
    T* values;
    T value;

    GIMDEM_HD void operator()(std::int64_t i) const { values[i] = value; }
};

/// Box of all centres, and whether all are finite.
struct CentreBox
{
    Constant3 low, high;  ///< [m]
    std::int32_t finite;
};

struct CentreBoxOf
{
    Quad const* position;

    GIMDEM_HD CentreBox operator()(std::int64_t i) const
    {
        Constant3 const x{position[i].x, position[i].y, position[i].z};
        // Neither infinity nor NaN has a difference of zero with itself.
        return {x, x, x.x - x.x == 0 && x.y - x.y == 0 && x.z - x.z == 0};
    }
};

struct JoinBoxes
{
    GIMDEM_HD CentreBox identity() const
    {
        constexpr double far = 1e300;
        return {{far, far, far}, {-far, -far, -far}, 1};
    }
    GIMDEM_HD CentreBox operator()(CentreBox const& a, CentreBox const& b) const
    {
        auto const least = [](double p, double q) { return q < p ? q : p; };
        auto const most = [](double p, double q) { return p < q ? q : p; };
        return {{least(a.low.x, b.low.x), least(a.low.y, b.low.y), least(a.low.z, b.low.z)},
                {most(a.high.x, b.high.x), most(a.high.y, b.high.y), most(a.high.z, b.high.z)},
                a.finite != 0 && b.finite != 0};
    }
};

template <class Device>
class DeviceNeighbors
{
public:
    template <class T>
    using Array = exec::DeviceArray<Device, T>;

    DeviceNeighbors(Device& device, double skin, Domain const& domain, bool carries_rolling)
        : device_(device),
          skin_(skin),
          domain_(domain),
          carries_rolling_(carries_rolling),
          centre_box_(device),
          stale_here_(device),
          number_(device)
    {
        stale_.resize(device, 1);
        stale_.zero(device);
    }

    double skin() const { return skin_; }
    std::int64_t pair_count() const { return first_.size(); }

    PairwiseView view() const
    {
        return {first_.data(),
                second_.data(),
                row_offsets_.data(),
                by_second_.offsets.data(),
                by_second_.members.data(),
                own_seconds_.data(),
                displacement_.data(),
                rolling_spring_.data(),
                touches_.data()};
    }

    /// Takes the list as it is on the host, or, where it is stale there, its springs only. `particles` are on the host
    /// too: their sizes decide about the grids.
    void upload(ParticleState const& particles, NeighborList const& list);

    /// Waits for it.
    void download(NeighborList& list) const;

    // Whether a particle moved more than half the skin since the list was built: who moves particles tests them.
    bool is_built() const { return is_built_; }
    StaleTest stale_test() const { return {is_built_ ? built_at_.data() : nullptr, skin_, stale_.data()}; }
    std::int32_t const* stale() const { return stale_.data(); }
    void ask_whether_stale() { stale_here_.ask(stale_.data()); }
    bool is_stale() { return stale_here_.answer() != 0; }

    /// Sorts the particles by level and cell, lists the pairs and carries the springs along. False, with nothing done,
    /// where a position is not finite. Returns the permutation in order().
    bool build(DeviceParticles<Device>& particles);
    std::int32_t const* order() const { return by_cell_.members.data(); }
    /// Corners of the box around all particles of the last build and what is within the skin of them [m].
    std::pair<Vec3, Vec3> reached() const
    {
        Vec3 const reach = Vec3::Constant(sizes_.largest_radius + skin_);
        return {box_.low.vec() - reach, box_.high.vec() + reach};
    }

private:
    bool sort_into_cells(DeviceParticles<Device>& particles);
    void list_pairs(DeviceParticles<Device> const& particles);
    void carry_springs();
    void sort_by_second();
    template <class Work>
    void with_candidates(DeviceParticles<Device> const& particles, Work&& work) const;

    Device& device_;
    double skin_;
    Domain domain_;
    bool carries_rolling_;
    bool is_built_ = false;
    bool has_springs_ = false;
    Extent sizes_{};  ///< radii only
    SizeCensus census_;
    CentreBox box_ = JoinBoxes{}.identity();
    SizeLevels levels_;

    Array<std::int32_t> first_, second_, row_offsets_, own_seconds_;
    exec::DeviceGroups<Device> by_second_, by_cell_;
    Array<Quad> displacement_, rolling_spring_, built_at_;
    Array<std::uint8_t> touches_;
    Array<std::int32_t> old_second_, old_row_offsets_, cell_of_, stale_;
    Array<Quad> old_displacement_, old_rolling_spring_;
    DevicePermute<Device, std::int32_t> permute_;
    exec::DeviceScan<Device> scan_;
    exec::DeviceSort<Device> sort_;
    exec::DeviceReduce<Device, CentreBox> centre_box_;
    exec::DeviceScalar<Device, std::int32_t> stale_here_, number_;
};

template <class Device>
void DeviceNeighbors<Device>::upload(ParticleState const& particles, NeighborList const& list)
{
    exec::Execution const one{};
    std::int64_t const n = particles.count();
    sizes_ = Extent::of(one, particles);
    census_ = SizeCensus::of(one, particles, sizes_);
    has_springs_ = list.row_offsets.size() == n + 1;
    is_built_ = n == 0 || (has_springs_ && list.built_at.size() == n);
    if (n == 0)
        for (auto* const pairs : {&first_, &second_})
            pairs->resize(device_, 0);
    if (!has_springs_) return;
    row_offsets_.upload(device_, list.row_offsets);
    second_.upload(device_, list.second);
    SpringsOfPairs const springs{tangential_of_pairs(list), rolling_of_pairs(list), touches_of_pairs(list)};
    exec::Buffer<std::int32_t> const first = first_of_pairs(list);
    exec::Buffer<Quad> built_at(list.built_at.size());
    for (std::int64_t i = 0; i < built_at.size(); ++i)
        built_at[i] = Quad::of(list.built_at[i].vec(), 0);
    displacement_.upload(device_, springs.tangential);
    if (carries_rolling_) rolling_spring_.upload(device_, springs.rolling);
    stale_.zero(device_);
    if (!is_built_ || n == 0) return device_.wait();
    first_.upload(device_, first);
    touches_.upload(device_, springs.touches);
    built_at_.upload(device_, built_at);
    device_.wait();  // before what they come from goes
    sort_by_second();
}

template <class Device>
void DeviceNeighbors<Device>::download(NeighborList& list) const
{
    SpringsOfPairs springs;
    exec::Buffer<Quad> built_at;
    row_offsets_.download(device_, list.row_offsets);
    second_.download(device_, list.second);
    displacement_.download(device_, springs.tangential);
    if (carries_rolling_) rolling_spring_.download(device_, springs.rolling);
    if (is_built_) touches_.download(device_, springs.touches);
    built_at_.download(device_, built_at);
    device_.wait();
    put_springs(springs, list);
    list.built_at.resize(built_at.size());
    for (std::int64_t i = 0; i < built_at.size(); ++i)
        list.built_at[i] = {built_at[i].x, built_at[i].y, built_at[i].z};
}

template <class Device>
bool DeviceNeighbors<Device>::build(DeviceParticles<Device>& particles)
{
    if (!sort_into_cells(particles)) return false;
    swap(old_second_, second_);
    swap(old_row_offsets_, row_offsets_);
    swap(old_displacement_, displacement_);
    swap(old_rolling_spring_, rolling_spring_);
    list_pairs(particles);
    carry_springs();
    built_at_.copy(device_, particles.position);
    stale_.zero(device_);
    is_built_ = has_springs_ = true;
    return true;
}

template <class Device>
bool DeviceNeighbors<Device>::sort_into_cells(DeviceParticles<Device>& particles)
{
    std::int64_t const n = particles.count();
    if (domain_.is_periodic()) device_.for_each(n, WrapKernel{particles.position.data(), domain_});
    CentreBox const box = centre_box_(n, CentreBoxOf{particles.position.data()}, JoinBoxes{});
    if (box.finite == 0) return false;
    box_ = box;
    domain_.require_room(2 * sizes_.largest_radius + skin_);
    Extent extent = sizes_;
    if (n > 0) extent = {box.low, box.high, sizes_.largest_radius, sizes_.smallest_radius};
    levels_ = SizeLevels::of(census_, extent, skin_, domain_);

    cell_of_.resize(device_, n);
    device_.for_each(n, CellKernel{particles.position.data(), levels_, cell_of_.data()});
    sort_(device_, {cell_of_.data(), n}, levels_.cell_count, by_cell_);
    particles.permute(device_, order());
    permute_(device_, cell_of_, order());
    return true;
}

/// Calls work(candidates, near) with the visitor and the test that fit the domain.
template <class Device>
template <class Work>
void DeviceNeighbors<Device>::with_candidates(DeviceParticles<Device> const& particles, Work&& work) const
{
    in_space_of(domain_,
                [&]<class Space>(Space space)
                {
                    constexpr bool periodic = !std::is_same_v<Space, OpenSpace>;
                    Quad const* const position = particles.position.data();
                    work(CandidateVisitor<periodic>{levels_, domain_.period, skin_, position, by_cell_.offsets.data(),
                                                    cell_of_.data()},
                         Nearness<Space>{position, skin_, space});
                });
}

template <class Device>
void DeviceNeighbors<Device>::list_pairs(DeviceParticles<Device> const& particles)
{
    std::int64_t const n = particles.count();
    row_offsets_.resize(device_, n + 1);
    with_candidates(particles,
                    [&]<class Candidates, class Near>(Candidates const& candidates, Near const& near) {
                        device_.for_each(n, PairCounter<Candidates, Near>{candidates, near, row_offsets_.data()});
                    });
    scan_(device_, row_offsets_.view());
    std::int64_t const pairs = number_.read(row_offsets_.data() + n);

    first_.resize(device_, pairs);
    second_.resize(device_, pairs);
    displacement_.resize(device_, pairs);
    rolling_spring_.resize(device_, carries_rolling_ ? pairs : 0);
    touches_.resize(device_, pairs);
    device_.for_each(pairs, FillKernel<std::uint8_t>{touches_.data(), 1});
    with_candidates(particles,
                    [&]<class Candidates, class Near>(Candidates const& candidates, Near const& near)
                    {
                        device_.for_each(n,
                                         PairFiller<Candidates, Near>{
                                             candidates, near, row_offsets_.data(), {first_.data()}, second_.data()});
                    });
    sort_by_second();
}

template <class Device>
void DeviceNeighbors<Device>::sort_by_second()
{
    std::int64_t const n = row_offsets_.size() - 1;
    sort_(device_, {second_.data(), second_.size()}, static_cast<std::int32_t>(n), by_second_);
    own_seconds_.resize(device_, n);
    device_.for_each(
        n, OwnSeconds{first_.data(), by_second_.offsets.data(), by_second_.members.data(), own_seconds_.data()});
}

template <class Device>
void DeviceNeighbors<Device>::carry_springs()
{
    if (!has_springs_)
    {
        displacement_.zero(device_);
        rolling_spring_.zero(device_);
        return;
    }
    SpringCarrier carrier{first_.data(),           second_.data(),     order(),
                          old_row_offsets_.data(), old_second_.data(), old_displacement_.data(),
                          displacement_.data()};
    device_.for_each(pair_count(), carrier);
    if (!carries_rolling_) return;
    carrier.old_displacement = old_rolling_spring_.data();
    carrier.displacement = rolling_spring_.data();
    device_.for_each(pair_count(), carrier);
}

}  // namespace gimdem
