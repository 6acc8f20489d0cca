// Fluxes of forward mode in the files of a result: rows of the CSV, variables of the NetCDF, a part of the
// report. All are fractions of the power that enters from their origin.
#pragma once
#include "core/json.h"
#include "simulate/forward/forward.h"
#include "simulate/output/netcdf.h"

namespace bpms {

// quantity = the flux, `material` = what it is of: a material, an organ, a plant, a layer. Pixels of the
// ground's map are in the NetCDF alone.
std::string flux_csv_rows(const Simulation& simulation, const FluxSensor& sensor, const FluxResult& result);
// Variables PREFIXreflected, PREFIXtransmitted ... (band), PREFIXabsorbed (material, band),
// PREFIXabsorbed_organ, _plant, _layer, PREFIXground_irradiance (y, x, band), each with _se and, with several
// origins, _direct and _diffuse.
void write_fluxes(const Simulation& simulation, const FluxResult& result, NetcdfWriter& file,
                  const std::string& prefix);
Json flux_report(const Simulation& simulation, const FluxSensor& sensor, const FluxResult& result);

}  // namespace bpms
