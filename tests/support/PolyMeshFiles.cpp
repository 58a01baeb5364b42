// SPDX-License-Identifier: BSD-3-Clause
#include "PolyMeshFiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "FoamText.hpp"
#include "core/Error.hpp"

namespace gimdem::test
{

namespace
{

using std::filesystem::path;

void read_points(path const& file, coupling::Mesh& mesh)
{
    FoamText text(file);
    int const count = text.integer();
    text.expect("(");
    for (int p = 0; p < count; ++p)
        for (double const x : text.vector())
            mesh.points.push_back(x);
    text.expect(")");
}

void read_faces(path const& file, coupling::Mesh& mesh)
{
    FoamText text(file);
    auto const point_count = static_cast<int>(mesh.points.size() / 3);
    int const count = text.integer();
    mesh.face_offsets = {0};
    text.expect("(");
    for (int f = 0; f < count; ++f)
    {
        for (int const p : text.integers())
        {
            if (p < 0 || p >= point_count) text.fail(fmt::format("face {} has a point {} that is not there", f, p));
            mesh.face_points.push_back(p);
        }
        mesh.face_offsets.push_back(static_cast<std::int32_t>(mesh.face_points.size()));
    }
    text.expect(")");
}

void read_cells(path const& folder, coupling::Mesh& mesh)
{
    FoamText owner(folder / "owner"), neighbour(folder / "neighbour");
    mesh.owner = owner.integers();
    mesh.neighbour = neighbour.integers();
    if (mesh.owner.size() + 1 != mesh.face_offsets.size())
        owner.fail(fmt::format("{} owners for {} faces", mesh.owner.size(), mesh.face_offsets.size() - 1));
    if (mesh.neighbour.size() > mesh.owner.size()) neighbour.fail("more neighbours than faces");
    for (auto const* const cells : {&mesh.owner, &mesh.neighbour})
        for (int const c : *cells)
        {
            if (c < 0) owner.fail(fmt::format("a face has the cell {}", c));
            mesh.cell_count = std::max(mesh.cell_count, c + 1);
        }
}

coupling::PatchKind kind_of(std::string_view type)
{
    using enum coupling::PatchKind;
    static std::map<std::string_view, coupling::PatchKind> const kinds{
        {"wall", wall},   {"symmetry", symmetry}, {"symmetryPlane", symmetry},
        {"empty", empty}, {"cyclic", cyclic},     {"processor", processor}};
    auto const at = kinds.find(type);
    return at == kinds.end() ? open : at->second;
}

// Entries of a patch end with ";"; of those that there are three count.
coupling::Patch read_patch(FoamText& text)
{
    coupling::Patch patch;
    patch.name = text.next();
    text.expect("{");
    while (!text.skip("}"))
    {
        std::string_view const key = text.next();
        if (key == "type") patch.kind = kind_of(text.next());
        if (key == "nFaces") patch.face_count = text.integer();
        if (key == "startFace") patch.start_face = text.integer();
        while (text.next() != ";")
        {
        }
    }
    return patch;
}

void read_boundary(path const& file, coupling::Mesh& mesh)
{
    FoamText text(file);
    int const count = text.integer();
    auto end = static_cast<std::int32_t>(mesh.neighbour.size());
    text.expect("(");
    for (int k = 0; k < count; ++k)
    {
        mesh.patches.push_back(read_patch(text));
        coupling::Patch const& patch = mesh.patches.back();
        if (patch.start_face != end)
            text.fail(fmt::format("patch {} starts at face {} and not at {}", patch.name, patch.start_face, end));
        end += patch.face_count;
    }
    if (end != static_cast<std::int32_t>(mesh.owner.size()))
        text.fail(fmt::format("the patches end at face {} of {}", end, mesh.owner.size()));
    text.expect(")");
}

}  // namespace

coupling::Mesh read_poly_mesh(path folder)
{
    if (exists(folder / "constant" / "polyMesh")) folder = folder / "constant" / "polyMesh";
    coupling::Mesh mesh;
    read_points(folder / "points", mesh);
    read_faces(folder / "faces", mesh);
    read_cells(folder, mesh);
    read_boundary(folder / "boundary", mesh);
    return mesh;
}

}  // namespace gimdem::test
