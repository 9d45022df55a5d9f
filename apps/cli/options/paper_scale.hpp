#pragma once
/// \file
/// Scales of drawings, in the notation 1:N.

#include <svt/record/record.hpp>

#include <string>

namespace svt::cli {

/// The number N of "1:N" or "N"; 0.01 to 10000000.
struct PaperScale : record::PlainCodec<PaperScale, double> {
    static void read(record::Faults& faults, const record::Json& json, const std::string& path, const Option& option,
                     double& to);
    static record::Json write(const Option& option, double from);
};

}  // namespace svt::cli
