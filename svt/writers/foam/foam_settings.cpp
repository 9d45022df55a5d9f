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
    {"system/controlDict", "dictionary", R"foam(application buoyantBoussinesqSimpleFoam;
startFrom latestTime;
startTime 0;
stopAt endTime;
// Iterations of a steady solver, which ends earlier at the residuals of fvSolution.
endTime 3000;
deltaT 1;
writeControl timeStep;
writeInterval 500;
purgeWrite 1;
writeFormat ascii;
writePrecision 9;
writeCompression off;
timeFormat general;
timePrecision 6;
runTimeModifiable no;
)foam"},
    {"system/fvSchemes", "dictionary", R"foam(ddtSchemes { default steadyState; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default none;
    div(phi,U) bounded Gauss upwind;
    div(phi,T) bounded Gauss upwind;
    div(phi,k) bounded Gauss upwind;
    div(phi,epsilon) bounded Gauss upwind;
    div((nuEff*dev2(T(grad(U))))) Gauss linear;
}
laplacianSchemes { default Gauss linear orthogonal; }
interpolationSchemes { default linear; }
snGradSchemes { default orthogonal; }
)foam"},
    {"system/fvSolution", "dictionary", R"foam(solvers
{
    p_rgh { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0.01; }
    "(U|T|k|epsilon)" { solver PBiCGStab; preconditioner DILU; tolerance 1e-8; relTol 0.1; }
}
SIMPLE
{
    nNonOrthogonalCorrectors 0;
    pRefCell 0;
    pRefValue 0;
    residualControl { p_rgh 1e-4; U 1e-4; T 1e-4; "(k|epsilon)" 1e-4; }
}
relaxationFactors
{
    fields { p_rgh 0.7; }
    equations { U 0.3; T 0.9; "(k|epsilon)" 0.7; }
}
)foam"},
    {"system/decomposeParDict", "dictionary", R"foam(numberOfSubdomains 2;
// Slices along x; Debian's OpenFOAM has no other method for any number of processes.
method simple;
coeffs { n (2 1 1); }
)foam"},
};

constexpr FoamText kTexts[] = {
    // ParaView opens the case by it.
    {"case.foam", ""},
    {"Allrun", R"foam(#!/bin/sh
# Runs the case: sh Allrun [PROCESSES]. More than one process needs MPI.
# Exit code: 2 if the residuals of system/fvSolution are not reached; the last iteration is kept.
set -e
cd "$(dirname "$0")"
export WM_PROJECT_DIR="${WM_PROJECT_DIR:-/usr/share/openfoam}"
processes="${1:-1}"
if [ "$processes" -le 1 ]; then
    buoyantBoussinesqSimpleFoam >log.solver
else
    foamDictionary -entry numberOfSubdomains -set "$processes" system/decomposeParDict
    foamDictionary -entry coeffs/n -set "($processes 1 1)" system/decomposeParDict
    decomposePar -force >log.decompose
    ${MPIRUN:-mpirun -np "$processes"} buoyantBoussinesqSimpleFoam -parallel >log.solver
    reconstructPar -latestTime >log.reconstruct
fi
if ! grep "solution converged" log.solver; then
    echo "Allrun: the residuals are not reached. Raise endTime in system/controlDict and run again. Air over warm" \
        "floors may stay unsteady: buoyantBoussinesqPimpleFoam computes that." >&2
    exit 2
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

- The air moves steadily by heat only (Boussinesq), without supply and exhaust air, with turbulence by k-epsilon.
- Each voxel of air is a cell. Oblique surfaces have steps, and their area is that of the sides of voxels.
- Components have the temperatures of `patches.csv`. Faces to other spaces and to background pass no heat.
- Air slips along faces to other spaces. All other faces stop it.
- Convection is discretized upwind: stable, and of first order.
- The run ends at the residuals of `system/fvSolution`, or after 3000 iterations with exit code 2. Times are iterations.

`patches.csv` names the component of each patch.
)foam"},
};

}  // namespace

std::span<const FoamSetting> foamSettings() noexcept { return kSettings; }
std::span<const FoamText> foamTexts() noexcept { return kTexts; }

}  // namespace svt::writers
