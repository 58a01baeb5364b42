// SPDX-License-Identifier: BSD-3-Clause
#include "walls/StlFile.hpp"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include "core/Error.hpp"

namespace gimdem
{

namespace
{

std::string content_of(std::filesystem::path const& file)
{
    if (!std::filesystem::is_regular_file(file))
        throw UserError(
            fmt::format("{} does not exist (it holds the triangles of a wall); give its path in [[wall]] "
                        "file, relative to the case file",
                        file.string()));
    std::ifstream in(file, std::ios::binary);
    std::string content(std::istreambuf_iterator<char>(in), {});
    if (in.bad()) throw UserError(fmt::format("{} cannot be read; check its permissions", file.string()));
    if (content.empty())
        throw UserError(fmt::format("{} is empty (a wall needs triangles); export the surface again", file.string()));
    return content;
}

/// Numbers points by their place: the bits of three coordinates, the two zeros alike.
class Welder
{
public:
    explicit Welder(SurfaceMesh& surface, double scale) : surface_(surface), scale_(scale) {}

    std::int32_t number_of(aiVector3D const& at)
    {
        std::array<std::uint32_t, 3> const key{bits(at.x), bits(at.y), bits(at.z)};
        auto const [place, is_new] = numbers_.emplace(key, static_cast<std::int32_t>(surface_.points.size()));
        if (is_new) surface_.points.push_back(scale_ * Vec3(at.x, at.y, at.z));
        return place->second;
    }

private:
    static std::uint32_t bits(float x) { return std::bit_cast<std::uint32_t>(x + 0.0f); }

    SurfaceMesh& surface_;
    double scale_;
    std::map<std::array<std::uint32_t, 3>, std::int32_t> numbers_;
};

}  // namespace

SurfaceMesh read_stl(std::filesystem::path const& file, double scale)
{
    std::string const content = content_of(file);
    Assimp::Importer importer;
    aiScene const* const scene = importer.ReadFileFromMemory(content.data(), content.size(), 0, "stl");
    if (scene == nullptr)
        throw UserError(fmt::format("{} is no whole STL file ({}); export the surface again, as ASCII or binary STL",
                                    file.string(), importer.GetErrorString()));
    SurfaceMesh surface;
    Welder weld(surface, scale);
    for (unsigned m = 0; m < scene->mNumMeshes; ++m)
    {
        aiMesh const& mesh = *scene->mMeshes[m];
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
        {
            aiFace const& face = mesh.mFaces[f];
            if (face.mNumIndices != 3)
                throw UserError(fmt::format("{}: face {} has {} corners (an STL file holds triangles); export it again",
                                            file.string(), surface.triangles.size() + 1, face.mNumIndices));
            SurfaceMesh::Triangle triangle{};
            for (unsigned k = 0; k < 3; ++k)
                triangle[k] = weld.number_of(mesh.mVertices[face.mIndices[k]]);
            surface.triangles.push_back(triangle);
        }
    }
    return surface;
}

}  // namespace gimdem
