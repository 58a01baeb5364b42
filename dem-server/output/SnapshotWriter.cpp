// SPDX-License-Identifier: BSD-3-Clause
#include "output/Hdf5.hpp"
#include "output/OutputFile.hpp"
#include "output/Snapshot.hpp"
#include "output/SnapshotSeal.hpp"

namespace gimdem::output
{

using hdf5::Handle;

struct SnapshotWriter::Image
{
    template <class T>
    void add(std::string const& name, std::span<T const> values, int components);

    /// `value` points to one value laid out as `memory_type`.
    void set(std::string const& name, hid_t file_type, hid_t memory_type, void const* value);

    hdf5::Silence silence;
    Handle file = hdf5::create_in_memory();
};

template <class T>
void SnapshotWriter::Image::add(std::string const& name, std::span<T const> values, int components)
{
    if (components < 1 || values.size() % static_cast<std::size_t>(components) != 0)
        throw std::invalid_argument("snapshot array " + name + ": " + std::to_string(values.size()) + " values, " +
                                    std::to_string(components) + " components");
    std::vector<hsize_t> sizes{values.size() / static_cast<std::size_t>(components)};
    if (components > 1) sizes.push_back(static_cast<hsize_t>(components));

    Handle const space = hdf5::make_space(sizes);
    Handle const properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "dataset properties");
    // no clock in the file: equal states give equal bytes
    hdf5::check(H5Pset_obj_track_times(properties.get(), false), "dataset properties");
    Handle const links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, "link properties");
    hdf5::check(H5Pset_create_intermediate_group(links.get(), 1), "link properties");
    Handle const data(H5Dcreate2(file.get(), name.c_str(), hdf5::Type<T>::file(), space.get(), links.get(),
                                 properties.get(), H5P_DEFAULT),
                      H5Dclose, "array " + name);
    hdf5::check(H5Dwrite(data.get(), hdf5::Type<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
                "array " + name);
}

void SnapshotWriter::Image::set(std::string const& name, hid_t file_type, hid_t memory_type, void const* value)
{
    Handle const space = hdf5::make_space({});
    Handle const attribute(H5Acreate2(file.get(), name.c_str(), file_type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                           H5Aclose, "value " + name);
    hdf5::check(H5Awrite(attribute.get(), memory_type, value), "value " + name);
}

SnapshotWriter::SnapshotWriter(std::filesystem::path file, std::string kind)
    : file_(std::move(file)), kind_(std::move(kind)), image_(std::make_unique<Image>())
{
}

SnapshotWriter::~SnapshotWriter() = default;

void SnapshotWriter::add(std::string const& name, std::span<double const> values, int components)
{
    image_->add(name, values, components);
}

void SnapshotWriter::add(std::string const& name, std::span<std::int64_t const> values, int components)
{
    image_->add(name, values, components);
}

void SnapshotWriter::add(std::string const& name, std::span<std::int32_t const> values, int components)
{
    image_->add(name, values, components);
}

void SnapshotWriter::set(std::string const& name, double value)
{
    image_->set(name, hdf5::Type<double>::file(), hdf5::Type<double>::memory(), &value);
}

void SnapshotWriter::set(std::string const& name, std::int64_t value)
{
    image_->set(name, hdf5::Type<std::int64_t>::file(), hdf5::Type<std::int64_t>::memory(), &value);
}

void SnapshotWriter::set(std::string const& name, std::string const& value)
{
    Handle const type(H5Tcopy(H5T_C_S1), H5Tclose, "type");
    hdf5::check(H5Tset_size(type.get(), value.size() + 1), "type");
    image_->set(name, type.get(), type.get(), value.c_str());
}

void SnapshotWriter::commit()
{
    auto const content = hdf5::image_of(image_->file);
    if (file_.has_parent_path()) make_folder(file_.parent_path());
    OutputFile out(file_);
    out.write(make_seal(snapshot_version, kind_, content));
    out.write(content);
    out.commit(OutputFile::Durability::machine);
}

}  // namespace gimdem::output
