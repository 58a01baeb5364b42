// SPDX-License-Identifier: BSD-3-Clause
#include "output/TraceFile.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/Error.hpp"
#include "output/Text.hpp"

namespace gimdem::output
{

TraceFile::TraceFile(std::filesystem::path const& file, double origin)
    : descriptor_(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)), origin_(origin), waiting_("[")
{
    if (descriptor_ < 0)
        throw UserError(fmt::format("the trace {} cannot be written ({}); leave out --trace, or make room",
                                    file.string(), std::strerror(errno)));
}

TraceFile::~TraceFile()
{
    close();
}

void TraceFile::name_process(int process, std::string const& name)
{
    add(fmt::format(R"({{"ph":"M","name":"process_name","pid":{0},"tid":{0},"args":{{"name":{1}}}}})", process,
                    json_quoted(name)));
    add(fmt::format(R"({{"ph":"M","name":"process_sort_index","pid":{0},"tid":{0},"args":{{"sort_index":{0}}}}})",
                    process));
}

void TraceFile::slice(int process, std::string_view name, double from, double to, std::int64_t step)
{
    if (!(to > from)) return;
    add(fmt::format(R"({{"ph":"X","name":"{}","pid":{},"tid":{},"ts":{},"dur":{:.3f},"args":{{"step":{}}}}})", name,
                    process, process, microseconds(from), 1e6 * (to - from), step));
}

void TraceFile::counter(int process, std::string_view name, double at, double value)
{
    if (!std::isfinite(value)) return;
    add(fmt::format(R"({{"ph":"C","name":"{0}","pid":{1},"ts":{2},"args":{{"{0}":{3}}}}})", name, process,
                    microseconds(at), to_text(value)));
}

void TraceFile::add(std::string const& event)
{
    if (descriptor_ < 0) return;
    waiting_ += is_empty_ ? "\n" : ",\n";
    waiting_ += event;
    is_empty_ = false;
}

std::string TraceFile::microseconds(double seconds) const
{
    return fmt::format("{:.3f}", 1e6 * (seconds - origin_));
}

void TraceFile::flush()
{
    if (descriptor_ < 0 || waiting_.empty()) return;
    bool const whole = ::write(descriptor_, waiting_.data(), waiting_.size()) == static_cast<ssize_t>(waiting_.size());
    waiting_.clear();
    if (whole) return;
    ::close(descriptor_);
    descriptor_ = -1;
}

void TraceFile::close()
{
    if (descriptor_ < 0) return;
    waiting_ += "\n]\n";
    flush();
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
}

}  // namespace gimdem::output
