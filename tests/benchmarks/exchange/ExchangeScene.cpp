// SPDX-License-Identifier: BSD-3-Clause
#include "ExchangeScene.hpp"

#include <algorithm>
#include <cmath>

#include "BoxMesh.hpp"

namespace gimdem::bench
{

namespace
{

/// Waves a few cells long, of full precision: what a bubbling bed's fields look like to a compressor.
std::vector<double> waves(std::size_t rows, std::size_t components, double mean)
{
    std::vector<double> values(rows * components);
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t k = 0; k < components; ++k)
        {
            auto const x = static_cast<double>(i);
            values[i * components + k] = mean + std::sin(0.05 * x + static_cast<double>(k)) * std::cos(0.0011 * x);
        }
    return values;
}

}  // namespace

Scene::Scene(std::array<int, 3> cells, double occupied)
    : size_(cells),
      count_(static_cast<std::size_t>(cells[0]) * static_cast<std::size_t>(cells[1]) *
             static_cast<std::size_t>(cells[2])),
      layers_(static_cast<int>(std::lround(occupied * cells[2]))),
      velocity_(waves(count_, 3, 1)),
      velocity_gradient_(waves(count_, 9, 0)),
      pressure_gradient_(waves(count_, 3, -7000)),
      void_fraction_gradient_(waves(count_, 3, 0)),
      pressure_(waves(count_, 1, 400)),
      void_fraction_(count_, 1.0),
      drag_coefficient_(count_, 0.0),
      drag_momentum_(3 * count_, 0.0)
{
    std::size_t const full = coupling::cell_count(*this->cells().solid);
    std::vector<double> const numbers = waves(full, 3, 2);
    for (std::size_t c = 0; c < full; ++c)
    {
        void_fraction_[c] = 0.45 + 0.05 * numbers[3 * c];
        drag_coefficient_[c] = 1000 * numbers[3 * c + 1];
        std::copy_n(&numbers[3 * c], 3, &drag_momentum_[3 * c]);
    }
}

coupling::Mesh Scene::mesh() const
{
    return test::BoxMesh::make(size_, {0.09, 0.008, 0.5});
}

coupling::FluidFields Scene::fluid() const
{
    coupling::FluidFields fields;
    fields.velocity = velocity_;
    fields.velocity_gradient = velocity_gradient_;
    fields.pressure_gradient = pressure_gradient_;
    fields.void_fraction_gradient = void_fraction_gradient_;
    fields.pressure = pressure_;
    return fields;
}

coupling::SolidFields Scene::solid() const
{
    coupling::SolidFields fields;
    fields.void_fraction = void_fraction_;
    fields.drag_coefficient = drag_coefficient_;
    fields.drag_momentum = drag_momentum_;
    return fields;
}

coupling::StepCells Scene::cells() const
{
    namespace field = coupling::field;
    auto const layers = [&](int count) {
        return coupling::CellRuns{{0, std::min(count, size_[2]) * size_[0] * size_[1]}};
    };
    coupling::CellRuns const plane{{layers_ / 2 * size_[0] * size_[1], size_[0] * size_[1]}};
    return {layers(layers_),
            {{{field::velocity}, layers(layers_ + 2)},
             {{field::velocity_gradient, field::pressure_gradient, field::void_fraction_gradient}, layers(layers_)},
             {{field::pressure}, plane}}};
}

std::vector<std::size_t> Scene::fluid_bytes(coupling::Encodings const& encodings) const
{
    auto const needed = cells().needed;
    std::size_t const number = encodings.float32 ? sizeof(float) : sizeof(double);
    auto const bytes = [&](std::size_t set, std::size_t components)
    {
        std::size_t const some = coupling::cell_count(needed[set].cells);
        bool const sparse = encodings.sparse && 4 * some <= 3 * count_;
        return (sparse ? some : count_) * components * number;
    };
    return {bytes(0, 3), bytes(1, 9), bytes(1, 3), bytes(1, 3), bytes(2, 1)};
}

std::vector<std::size_t> Scene::solid_bytes(coupling::Encodings const& encodings) const
{
    std::size_t const some = coupling::cell_count(*cells().solid);
    std::size_t const rows = encodings.sparse && 4 * some <= 3 * count_ ? some : count_;
    std::size_t const number = encodings.float32 ? sizeof(float) : sizeof(double);
    return {rows * number, rows * number, 3 * rows * number};
}

}  // namespace gimdem::bench
