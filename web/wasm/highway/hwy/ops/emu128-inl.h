// Stands before Highway's own file of this name: its portable vectors, and for vectors of two 64-bit lanes the operations
// that our kernels use by WebAssembly's SIMD. Highway 1.0.3 has a target for WebAssembly, but one without doubles, and its
// portable Floor(), Round(), Min() and masks are loops with branches, which no compiler turns into instructions.
//
// The results are those of the x86 targets. ConvertTo() is for numbers up to 2^51: there are no instructions for 64 bits.
#include_next <hwy/ops/emu128-inl.h>

#include <stdint.h>

#include <wasm_simd128.h>

HWY_BEFORE_NAMESPACE();
namespace hwy {
namespace HWY_NAMESPACE {
namespace simd {

typedef double F64 __attribute__((__vector_size__(16)));
typedef int64_t I64 __attribute__((__vector_size__(16)));
typedef uint64_t U64 __attribute__((__vector_size__(16)));
typedef int32_t Bits __attribute__((__vector_size__(16)));

using VF = Vec128<double, 2>;
using VS = Vec128<int64_t, 2>;
using VU = Vec128<uint64_t, 2>;
using MF = Mask128<double, 2>;
using MS = Mask128<int64_t, 2>;
using MU = Mask128<uint64_t, 2>;
using DF = Simd<double, 2, 0>;
using DS = Simd<int64_t, 2, 0>;
using DU = Simd<uint64_t, 2, 0>;

template <class To, class From>
HWY_API To as(From from) {
  return __builtin_bit_cast(To, from);
}

// An unaligned vector in memory.
template <class Native>
struct __attribute__((__packed__, __may_alias__)) InMemory {
  Native vector;
};
template <class Native>
HWY_API Native load(const void* from) {
  return static_cast<const InMemory<Native>*>(from)->vector;
}
template <class Native>
HWY_API void store(Native vector, void* to) {
  static_cast<InMemory<Native>*>(to)->vector = vector;
}

constexpr double kMagic = 6755399441055744.0;  // 1.5 * 2^52: the lowest bits of a sum with it are an integer

}  // namespace simd

// ------------------------------ Vectors of each kind, and masks

#define SVT_LOGICAL(V)                                                  \
  HWY_API V And(const V a, const V b) {                                 \
    return simd::as<V>(simd::as<simd::U64>(a) & simd::as<simd::U64>(b)); \
  }                                                                     \
  HWY_API V Or(const V a, const V b) {                                  \
    return simd::as<V>(simd::as<simd::U64>(a) | simd::as<simd::U64>(b)); \
  }                                                                     \
  HWY_API V Xor(const V a, const V b) {                                 \
    return simd::as<V>(simd::as<simd::U64>(a) ^ simd::as<simd::U64>(b)); \
  }                                                                     \
  HWY_API V Not(const V a) { return simd::as<V>(~simd::as<simd::U64>(a)); } \
  HWY_API V AndNot(const V a, const V b) {                              \
    return simd::as<V>(~simd::as<simd::U64>(a) & simd::as<simd::U64>(b)); \
  }

SVT_LOGICAL(simd::VF)
SVT_LOGICAL(simd::VS)
SVT_LOGICAL(simd::VU)
SVT_LOGICAL(simd::MF)
SVT_LOGICAL(simd::MS)
SVT_LOGICAL(simd::MU)
#undef SVT_LOGICAL

#define SVT_MASKS(D, T, V, M, NATIVE)                                          \
  HWY_API V Zero(D) { return simd::as<V>(NATIVE{0, 0}); }                      \
  template <class T2>                                                          \
  HWY_API V Set(D, const T2 t) {                                               \
    return simd::as<V>(NATIVE{static_cast<T>(t), static_cast<T>(t)});          \
  }                                                                            \
  HWY_API V Load(D, const T* HWY_RESTRICT from) {                              \
    return simd::as<V>(simd::load<NATIVE>(from));                              \
  }                                                                            \
  HWY_API V LoadU(D, const T* HWY_RESTRICT from) {                             \
    return simd::as<V>(simd::load<NATIVE>(from));                              \
  }                                                                            \
  HWY_API void Store(const V v, D, T* HWY_RESTRICT to) {                       \
    simd::store(simd::as<NATIVE>(v), to);                                      \
  }                                                                            \
  HWY_API void StoreU(const V v, D, T* HWY_RESTRICT to) {                      \
    simd::store(simd::as<NATIVE>(v), to);                                      \
  }                                                                            \
  HWY_API V IfThenElse(const M mask, const V yes, const V no) {                \
    return simd::as<V>(__builtin_wasm_bitselect(simd::as<simd::Bits>(yes), simd::as<simd::Bits>(no), \
                                                simd::as<simd::Bits>(mask)));  \
  }                                                                            \
  HWY_API V IfThenElseZero(const M mask, const V yes) {                        \
    return simd::as<V>(simd::as<simd::U64>(mask) & simd::as<simd::U64>(yes));  \
  }                                                                            \
  HWY_API V IfThenZeroElse(const M mask, const V no) {                         \
    return simd::as<V>(~simd::as<simd::U64>(mask) & simd::as<simd::U64>(no));  \
  }                                                                            \
  HWY_API M MaskFromVec(const V v) { return simd::as<M>(v); }                  \
  HWY_API V VecFromMask(const M mask) { return simd::as<V>(mask); }            \
  HWY_API V VecFromMask(D, const M mask) { return simd::as<V>(mask); }         \
  HWY_API bool AllFalse(D, const M mask) {                                     \
    return !__builtin_wasm_any_true_v128(simd::as<__i8x16>(mask));             \
  }                                                                            \
  HWY_API bool AllTrue(D, const M mask) {                                      \
    return __builtin_wasm_all_true_i64x2(simd::as<__i64x2>(mask));             \
  }                                                                            \
  HWY_API size_t FindKnownFirstTrue(D, const M mask) {                         \
    return simd::as<simd::U64>(mask)[0] != 0 ? 0 : 1;                          \
  }                                                                            \
  HWY_API size_t StoreMaskBits(D, const M mask, uint8_t* bits) {               \
    bits[0] = static_cast<uint8_t>(__builtin_wasm_bitmask_i64x2(simd::as<__i64x2>(mask))); \
    return 1;                                                                  \
  }                                                                            \
  HWY_API T GetLane(const V v) { return simd::as<NATIVE>(v)[0]; }              \
  HWY_API T ExtractLane(const V v, size_t lane) {                              \
    return lane == 0 ? simd::as<NATIVE>(v)[0] : simd::as<NATIVE>(v)[1];        \
  }                                                                            \
  HWY_API V Add(const V a, const V b) {                                        \
    return simd::as<V>(simd::as<NATIVE>(a) + simd::as<NATIVE>(b));             \
  }                                                                            \
  HWY_API V Sub(const V a, const V b) {                                        \
    return simd::as<V>(simd::as<NATIVE>(a) - simd::as<NATIVE>(b));             \
  }

SVT_MASKS(simd::DF, double, simd::VF, simd::MF, simd::F64)
SVT_MASKS(simd::DS, int64_t, simd::VS, simd::MS, simd::I64)
SVT_MASKS(simd::DU, uint64_t, simd::VU, simd::MU, simd::U64)
#undef SVT_MASKS

#define SVT_COMPARE(V, M, NATIVE)                                      \
  HWY_API M Eq(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) == simd::as<NATIVE>(b));    \
  }                                                                    \
  HWY_API M Ne(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) != simd::as<NATIVE>(b));    \
  }                                                                    \
  HWY_API M Lt(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) < simd::as<NATIVE>(b));     \
  }                                                                    \
  HWY_API M Le(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) <= simd::as<NATIVE>(b));    \
  }                                                                    \
  HWY_API M Gt(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) > simd::as<NATIVE>(b));     \
  }                                                                    \
  HWY_API M Ge(const V a, const V b) {                                 \
    return simd::as<M>(simd::as<NATIVE>(a) >= simd::as<NATIVE>(b));    \
  }

SVT_COMPARE(simd::VF, simd::MF, simd::F64)
SVT_COMPARE(simd::VS, simd::MS, simd::I64)
#undef SVT_COMPARE

#define SVT_CAST(TO, D, FROM) \
  HWY_API TO BitCast(D, const FROM v) { return simd::as<TO>(v); }
SVT_CAST(simd::VF, simd::DF, simd::VS)
SVT_CAST(simd::VF, simd::DF, simd::VU)
SVT_CAST(simd::VS, simd::DS, simd::VF)
SVT_CAST(simd::VS, simd::DS, simd::VU)
SVT_CAST(simd::VU, simd::DU, simd::VF)
SVT_CAST(simd::VU, simd::DU, simd::VS)
#undef SVT_CAST
HWY_API simd::MF RebindMask(simd::DF, const simd::MS mask) { return simd::as<simd::MF>(mask); }
HWY_API simd::MS RebindMask(simd::DS, const simd::MF mask) { return simd::as<simd::MS>(mask); }

// ------------------------------ Doubles

HWY_API simd::VF Mul(const simd::VF a, const simd::VF b) {
  return simd::as<simd::VF>(simd::as<simd::F64>(a) * simd::as<simd::F64>(b));
}
HWY_API simd::VF Div(const simd::VF a, const simd::VF b) {
  return simd::as<simd::VF>(simd::as<simd::F64>(a) / simd::as<simd::F64>(b));
}
HWY_API simd::VF Neg(const simd::VF v) { return simd::as<simd::VF>(-simd::as<simd::F64>(v)); }
HWY_API simd::VF Abs(const simd::VF v) { return simd::as<simd::VF>(__builtin_wasm_abs_f64x2(simd::as<__f64x2>(v))); }
HWY_API simd::VF Sqrt(const simd::VF v) { return simd::as<simd::VF>(__builtin_wasm_sqrt_f64x2(simd::as<__f64x2>(v))); }
HWY_API simd::VF Floor(const simd::VF v) { return simd::as<simd::VF>(__builtin_wasm_floor_f64x2(simd::as<__f64x2>(v))); }
HWY_API simd::VF Round(const simd::VF v) {
  return simd::as<simd::VF>(__builtin_wasm_nearest_f64x2(simd::as<__f64x2>(v)));
}
// As minpd and maxpd, which return the second argument where one is no number.
HWY_API simd::VF Min(const simd::VF a, const simd::VF b) {
  return simd::as<simd::VF>(__builtin_wasm_pmin_f64x2(simd::as<__f64x2>(b), simd::as<__f64x2>(a)));
}
HWY_API simd::VF Max(const simd::VF a, const simd::VF b) {
  return simd::as<simd::VF>(__builtin_wasm_pmax_f64x2(simd::as<__f64x2>(b), simd::as<__f64x2>(a)));
}
HWY_API simd::VF MinOfLanes(simd::DF d, const simd::VF v) {
  const simd::F64 f = simd::as<simd::F64>(v);
  return Set(d, f[1] < f[0] ? f[1] : f[0]);
}
HWY_API simd::VF MaxOfLanes(simd::DF d, const simd::VF v) {
  const simd::F64 f = simd::as<simd::F64>(v);
  return Set(d, f[0] < f[1] ? f[1] : f[0]);
}

// ------------------------------ Integers

HWY_API simd::VS Min(const simd::VS a, const simd::VS b) { return IfThenElse(Lt(b, a), b, a); }
HWY_API simd::VS Max(const simd::VS a, const simd::VS b) { return IfThenElse(Lt(a, b), b, a); }
HWY_API simd::VS MinOfLanes(simd::DS d, const simd::VS v) {
  const simd::I64 n = simd::as<simd::I64>(v);
  return Set(d, n[1] < n[0] ? n[1] : n[0]);
}
HWY_API simd::VS MaxOfLanes(simd::DS d, const simd::VS v) {
  const simd::I64 n = simd::as<simd::I64>(v);
  return Set(d, n[0] < n[1] ? n[1] : n[0]);
}
template <int kBits>
HWY_API simd::VS ShiftLeft(const simd::VS v) {
  return simd::as<simd::VS>(simd::as<simd::U64>(v) << kBits);
}
template <int kBits>
HWY_API simd::VU ShiftLeft(const simd::VU v) {
  return simd::as<simd::VU>(simd::as<simd::U64>(v) << kBits);
}
template <int kBits>
HWY_API simd::VS ShiftRight(const simd::VS v) {
  return simd::as<simd::VS>(simd::as<simd::I64>(v) >> kBits);
}
template <int kBits>
HWY_API simd::VU ShiftRight(const simd::VU v) {
  return simd::as<simd::VU>(simd::as<simd::U64>(v) >> kBits);
}
HWY_API simd::VU Shr(const simd::VU v, const simd::VU bits) {
  const simd::U64 a = simd::as<simd::U64>(v), b = simd::as<simd::U64>(bits);
  return simd::as<simd::VU>(simd::U64{a[0] >> (b[0] & 63), a[1] >> (b[1] & 63)});
}
HWY_API simd::VS GatherOffset(simd::DS, const int64_t* HWY_RESTRICT base, const simd::VS offset) {
  const simd::I64 at = simd::as<simd::I64>(offset);
  const auto element = [base](int64_t bytes) {
    int64_t value;
    __builtin_memcpy(&value, reinterpret_cast<const uint8_t*>(base) + static_cast<intptr_t>(bytes), sizeof value);
    return value;
  };
  return simd::as<simd::VS>(simd::I64{element(at[0]), element(at[1])});
}
HWY_API simd::VF ConvertTo(simd::DF d, const simd::VS v) {
  const simd::VF magic = Set(d, simd::kMagic);
  return Sub(simd::as<simd::VF>(Add(v, simd::as<simd::VS>(magic))), magic);
}
HWY_API simd::VS ConvertTo(simd::DS, const simd::VF v) {
  const simd::VF magic = Set(simd::DF(), simd::kMagic);
  const simd::VF whole = simd::as<simd::VF>(__builtin_wasm_trunc_f64x2(simd::as<__f64x2>(v)));
  return Sub(simd::as<simd::VS>(Add(whole, magic)), simd::as<simd::VS>(magic));
}

}  // namespace HWY_NAMESPACE
}  // namespace hwy
HWY_AFTER_NAMESPACE();
