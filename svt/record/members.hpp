#pragma once
/// \file
/// The members of a struct, for headers. Next to a struct with a JSON representation or options, its header declares
/// `record::Members<T> membersOf(const T*) noexcept;`. Everything else is in record.hpp, which needs a JSON library.

#include <span>

namespace svt::record {

template <class Owner>
struct Member;

/// The members of a struct, in the order in which they are written.
template <class T>
using Members = std::span<const Member<T>>;

}  // namespace svt::record
