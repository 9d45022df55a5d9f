#include <svt/writers/foam/foam_settings.hpp>

namespace svt::writers {
namespace {

constexpr FoamSetting kSettings[] = {
    {"constant/g", "uniformDimensionedVectorField", R"foam(dimensions [0 1 -2 0 0 0 0];
value (0 0 -9.81);
)foam"},
    {"constant/turbulenceProperties", "dictionary", R"foam(simulationType RAS;
RAS
{
    RASModel kEpsilon;
    turbulence on;
    printCoeffs off;
}
)foam"},
    {"system/controlDict", "dictionary", R"foam(application buoyantBoussinesqPimpleFoam;
startFrom latestTime;
startTime 0;
stopAt endTime;
// Seconds after air at rest, with the mean temperature of the surfaces.
endTime 900;
deltaT 0.1;
adjustTimeStep yes;
maxCo 1;
maxDeltaT 5;
writeControl adjustableRunTime;
writeInterval 60;
purgeWrite 0;
writeFormat ascii;
writePrecision 9;
writeCompression off;
timeFormat general;
timePrecision 6;
runTimeModifiable no;
)foam"},
    {"system/fvSchemes", "dictionary", R"foam(ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,U) Gauss upwind;
    div(phi,T) Gauss upwind;
    div(phi,k) Gauss upwind;
    div(phi,epsilon) Gauss upwind;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes { default Gauss linear orthogonal; }
interpolationSchemes { default linear; }
snGradSchemes { default orthogonal; }
)foam"},
    {"system/fvSolution", "dictionary", R"foam(solvers
{
    p_rgh { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0.01; }
    p_rghFinal { $p_rgh; relTol 0; }
    "(U|T|k|epsilon)" { solver PBiCGStab; preconditioner DILU; tolerance 1e-8; relTol 0.1; }
    "(U|T|k|epsilon)Final" { $U; relTol 0; }
}
PIMPLE
{
    momentumPredictor yes;
    nOuterCorrectors 1;
    nCorrectors 2;
    nNonOrthogonalCorrectors 0;
    pRefCell 0;
    pRefValue 0;
}
)foam"},
    {"system/decomposeParDict", "dictionary", R"foam(numberOfSubdomains 2;
// Slices along x. Debian's OpenFOAM lacks the method scotch.
method simple;
coeffs { n (2 1 1); }
)foam"},
};

constexpr FoamText kTexts[] = {
    // ParaView opens the case by it.
    {"case.foam", ""},
    {"Allrun", R"foam(#!/bin/sh
# Runs the case: sh Allrun [PROCESSES]. More than one process needs MPI.
set -e
cd "$(dirname "$0")"
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}"
processes="${1:-1}"
if [ "$processes" -le 1 ]; then
    buoyantBoussinesqPimpleFoam >log.solver
else
    foamDictionary -entry numberOfSubdomains -set "$processes" system/decomposeParDict
    foamDictionary -entry coeffs/n -set "($processes 1 1)" system/decomposeParDict
    decomposePar -force >log.decompose
    ${MPIRUN:-mpirun -np "$processes"} buoyantBoussinesqPimpleFoam -parallel >log.solver
    reconstructPar >log.reconstruct
fi
)foam"},
    {"Allrun.slurm", R"foam(#!/bin/sh
#SBATCH --job-name=foam
#SBATCH --nodes=1
#SBATCH --ntasks=2
# Runs the case as a job: sbatch Allrun.slurm; --ntasks is the number of processes.
cd "$SLURM_SUBMIT_DIR" && sh Allrun "$SLURM_NTASKS"
)foam"},
    {"README.md", R"foam(# Air of rooms

A case for OpenFOAM (openfoam.com, v1912 and later). `sh Allrun` computes it, `sh Allrun 4` with four processes,
`sbatch Allrun.slurm` as a job of Slurm. ParaView opens `case.foam`. `svt field add VOLUME.svt FOLDER.foam` reads the
results into the volume.

Assumptions:

- The air moves by heat only (Boussinesq), without supply and exhaust air, with turbulence by k-epsilon.
- At 0 s, the air is at rest and has the mean temperature of the surfaces. Surfaces keep their temperatures.
- Each voxel of air is a cell. Oblique surfaces have steps, and their area is that of the sides of voxels.
- Components have the temperatures of `patches.csv`. Faces to other spaces and to background pass no heat.
- Air slips along faces to other spaces. All other faces stop it.
- Convection is discretized upwind: stable, and of first order.
- The run ends after 900 s, with results every 60 s. Compare the last ones to see whether the air still changes.

`patches.csv` names the component of each patch.
)foam"},
};

}  // namespace

std::span<const FoamSetting> foamSettings() noexcept { return kSettings; }
std::span<const FoamText> foamTexts() noexcept { return kTexts; }

}  // namespace svt::writers
