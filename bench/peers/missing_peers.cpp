// Stand-ins for the peers that were not installed at build time.
#include <bench/peers.hpp>

namespace svt::bench {

#ifndef SVT_BENCH_VTK
Peer<SolidPeer> makeVtkStencils() { return {nullptr, "VTK: not installed when the benchmark was built"}; }
Peer<VolumePeer> makeVtkVolume(VtkMapper) { return {nullptr, "VTK: not installed when the benchmark was built"}; }
#endif
#ifndef SVT_BENCH_OPENVDB
Peer<SolidPeer> makeOpenVdb() { return {nullptr, "OpenVDB: not installed when the benchmark was built"}; }
#endif
#ifndef SVT_BENCH_CITYGML
Peer<ReaderPeer> makeLibcitygml() { return {nullptr, "libcitygml: not installed when the benchmark was built"}; }
#endif

}  // namespace svt::bench
