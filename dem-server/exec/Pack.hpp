// SPDX-License-Identifier: BSD-3-Clause
/// A register of numbers that computes like one number. A law written for a type Real serves a number and a Pack alike.
#pragma once

#include <cstdint>

namespace gimdem::exec
{

/// `lanes` numbers taken together. The vector is the compiler's own: it becomes the registers of whatever processor the
/// code is compiled for.
template <class Number_, int lanes_>
struct Pack
{
    using Number = Number_;
    static constexpr int lanes = lanes_;
    using Vector [[gnu::vector_size(sizeof(Number) * lanes)]] = Number;

    Vector v;

    Pack() = default;
    Pack(Vector const& all) : v(all) {}
    /// The same number in every lane.
    static Pack Constant(double x) { return Number(x) - Vector{}; }

    Number& operator[](int lane) { return reinterpret_cast<Number*>(&v)[lane]; }
    Number operator[](int lane) const { return v[lane]; }

    friend Pack operator+(Pack const& a, Pack const& b) { return a.v + b.v; }
    friend Pack operator-(Pack const& a, Pack const& b) { return a.v - b.v; }
    friend Pack operator*(Pack const& a, Pack const& b) { return a.v * b.v; }
    friend Pack operator/(Pack const& a, Pack const& b) { return a.v / b.v; }
    friend Pack operator-(Pack const& a) { return -a.v; }

    friend Pack operator+(double a, Pack const& b) { return Number(a) + b.v; }
    friend Pack operator-(double a, Pack const& b) { return Number(a) - b.v; }
    friend Pack operator*(double a, Pack const& b) { return Number(a) * b.v; }
    friend Pack operator/(double a, Pack const& b) { return Number(a) / b.v; }
    friend Pack operator+(Pack const& a, double b) { return a.v + Number(b); }
    friend Pack operator-(Pack const& a, double b) { return a.v - Number(b); }
    friend Pack operator*(Pack const& a, double b) { return a.v * Number(b); }
    friend Pack operator/(Pack const& a, double b) { return a.v / Number(b); }

    Pack& operator-=(Pack const& b) { return *this = *this - b; }
};

/// Which lanes of a Pack: every bit of a lane is set, or none.
template <class Number, int n>
struct Mask
{
    using Vector = typename Pack<Number, n>::Vector;
    decltype(Vector{} > Vector{}) lanes;
};

template <class Number, int n>
Mask<Number, n> greater(Pack<Number, n> const& a, Pack<Number, n> const& b)
{
    return {a.v > b.v};
}
template <class Number, int n>
Pack<Number, n> choose(Mask<Number, n> const& condition, Pack<Number, n> const& yes, Pack<Number, n> const& no)
{
    return condition.lanes ? yes.v : no.v;
}

}  // namespace gimdem::exec
