// SPDX-License-Identifier: BSD-3-Clause
/// Fuzz target: any mesh off the wire is refused, or is one whose every index can be followed.
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

#include "BoxMesh.hpp"
#include "Bytes.hpp"
#include "MessageMaker.hpp"
#include "RawMessages.hpp"
#include "core/Error.hpp"
#include "mesh/PolyMesh.hpp"
#include "message/Codec.hpp"
#include "message/MeshMessage.hpp"

namespace gimdem::fuzz
{
namespace
{

using coupling::Mesh;

[[noreturn]] void report(char const* what)
{
    std::cerr << "finding: " << what << std::endl;
    std::abort();
}

template <class T>
void edit_array(std::vector<T>& values, Bytes& input)
{
    unsigned const how = input.choose(8);
    if (how == 0) return values.resize(input.choose(static_cast<unsigned>(values.size()) + 3));
    if (values.empty()) return;
    std::size_t const i = input.raw<std::uint16_t>() % values.size();
    if (how == 1) return static_cast<void>(values.erase(values.begin() + static_cast<std::ptrdiff_t>(i)));
    if (how == 2) return static_cast<void>(values.insert(values.begin() + static_cast<std::ptrdiff_t>(i), values[i]));
    if (how == 3) return std::swap(values[i], values[input.byte() % values.size()]);
    values[i] = how < 6 ? static_cast<T>(static_cast<std::int8_t>(input.byte())) : input.raw<T>();
}

void edit(Mesh& mesh, Bytes& input)
{
    switch (input.choose(7))
    {
        case 0:
            return edit_array(mesh.points, input);
        case 1:
            return edit_array(mesh.face_offsets, input);
        case 2:
            return edit_array(mesh.face_points, input);
        case 3:
            return edit_array(mesh.owner, input);
        case 4:
            return edit_array(mesh.neighbour, input);
        case 5:
            mesh.cell_count = input.once_in(4) ? input.raw<std::int32_t>() : input.choose(40);
            return;
        default:
            if (mesh.patches.empty() || input.choose(4) == 0) return mesh.patches.push_back({"more", {}, 0, 0});
            auto& patch = mesh.patches[input.choose(static_cast<unsigned>(mesh.patches.size()))];
            if (input.choose(4) == 0) return mesh.patches.pop_back();
            (input.choose(2) == 0 ? patch.start_face : patch.face_count) =
                input.once_in(4) ? input.raw<std::int32_t>() : static_cast<std::int8_t>(input.byte());
    }
}

/// Independently of the check: what does each index lead to?
void follow_indices(Mesh const& mesh)
{
    auto const inside = [](auto const& numbers, std::size_t count)
    {
        for (std::int32_t const number : numbers)
            if (number < 0 || static_cast<std::size_t>(number) >= count) report("an accepted index leads nowhere");
    };
    inside(mesh.face_points, mesh.points.size() / 3);
    inside(mesh.owner, static_cast<std::size_t>(mesh.cell_count));
    inside(mesh.neighbour, static_cast<std::size_t>(mesh.cell_count));
    if (mesh.face_offsets.size() != mesh.owner.size() + 1) report("an accepted face has no offset");
    inside(mesh.face_offsets, mesh.face_points.size() + 1);
    for (coupling::Patch const& patch : mesh.patches)
        if (patch.start_face < 0 || std::size_t(patch.start_face) + std::size_t(patch.face_count) > mesh.owner.size())
            report("an accepted patch has faces that are none");
}

void run(Bytes input)
{
    int const nx = 1 + static_cast<int>(input.choose(2));
    int const nz = 1 + static_cast<int>(input.choose(3));
    Mesh mesh = test::BoxMesh::make({nx, 1, nz}, {1, 1, 1});
    for (unsigned edits = input.choose(6); edits > 0 && !input.empty(); --edits)
        edit(mesh, input);
    test::RawMessage raw = test::raw_mesh(mesh);
    raw.envelope.set_protocol_major(1);

    Mesh accepted = coupling::message::unpack_mesh(coupling::message::decode(frames_of(raw, input)));
    follow_indices(accepted);
    PolyMesh const geometry(std::move(accepted));
    for (std::int32_t face = 0; face < geometry.face_count(); ++face)
        if (geometry.points_of_face(face).size() < 3) report("an accepted face has no area");
}

}  // namespace
}  // namespace gimdem::fuzz

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size)
{
    using gimdem::coupling::Fault;
    try
    {
        gimdem::fuzz::run({data, size});
    }
    catch (gimdem::coupling::CouplingError const& error)
    {
        if (error.fault() != Fault::protocol && error.fault() != Fault::version)
            gimdem::fuzz::report("the peer's mistake is told as another fault");
    }
    catch (gimdem::UserError const& error)
    {
        if (*error.what() == 0) gimdem::fuzz::report("a mesh is refused without a reason");
    }
    return 0;
}
