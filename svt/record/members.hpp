#pragma once
/// \file
/// The members of a struct, for headers: a struct that has a JSON form or options declares
/// `record::Members<T> membersOf(const T*) noexcept;` beside it. record.hpp has all else, and needs a JSON library.

#include <span>

namespace svt::record {

template <class Owner>
struct Member;

/// The members of a struct, in the order in which they are written.
template <class T>
using Members = std::span<const Member<T>>;

}  // namespace svt::record
