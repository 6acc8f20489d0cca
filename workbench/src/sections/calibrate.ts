// Cameras from photographs of a target: parameters, residuals, stereo pairs.

import { calibrate as read } from "../data";
import { boardResiduals } from "../figures/board_residuals";
import { errorsByView, quiverByCamera, residualScatter } from "../figures/calibration";
import { calibrationScene } from "../figures/calibration_scene";
import { correlationMatrix } from "../figures/correlation";
import { coverage } from "../figures/coverage";
import { halfSetDifference, modelDifference, projectionSigma } from "../figures/image_maps";
import { errorsByFrame, normalCurve } from "../figures/residual_statistics";
import { triangulationCurves } from "../figures/triangulation";
import { count, length, percent, plural, significant } from "../format";
import { bestSigma, lensTable, pairTable, parameterTable, targetTables, viewTables } from "./calibrate_tables";
import { defineSection } from "./section";

export const calibrate = defineSection({
  kind: "calibrate",
  step: "calibrate",
  title: "Calibration of the cameras",
  explanation:
    "Photographs of a target of known size give each camera's lens model and the pose of the cameras to each other. " +
    "Image coordinates are in pixels with pixel centres at integers, u to the right and v down; a residual is the detected corner minus the predicted one.",
  read,
  summarise: (r) => {
    const pair = r.pairs.find((p) => p.baseline_m !== null);
    const rms = r.residual_rms_px === null ? "" : ` to ${significant(r.residual_rms_px, 3)} px rms per axis`;
    const used = r.corners_used === null ? "" : ` from ${count(r.corners_used)} corners`;
    return {
      sentence: r.cameras.length > 0 ? `${plural(r.cameras.length, "camera")} calibrated${used}${rms}.` : null,
      cards: [
        ...(r.residual_rms_px === null ? [] : [{ label: "Calibration residual", value: `${significant(r.residual_rms_px, 3)} px`, note: "rms per axis" }]),
        ...(pair ? [{ label: `Baseline ${pair.a ?? ""} – ${pair.b ?? ""}`, value: length(pair.baseline_m, bestSigma(pair)) }] : []),
      ],
    };
  },
  render: (r, s) => {
    if (r.converged === false) s.note("The solution did not converge: read the figures below with care.");
    const share = r.corners_used !== null && r.corners_total ? ` (${percent(r.corners_used / r.corners_total, 3)})` : "";
    const warp = r.board_warp_m.filter((w): w is number => w !== null);
    s.cards([
      ...(r.residual_rms_px === null ? [] : [{ label: "Residual, rms per axis", value: `${significant(r.residual_rms_px, 3)} px` }]),
      ...(r.residual_sigma_px === null ? [] : [{ label: "Residual σ", value: `${significant(r.residual_sigma_px, 3)} px`, note: "with degrees of freedom" }]),
      ...(r.corners_used === null ? [] : [{ label: "Corners used", value: count(r.corners_used), note: `of ${count(r.corners_total)}${share}` }]),
      ...(r.views.length === 0 ? [] : [{ label: "Views", value: count(r.views.length), note: `${count(r.views.filter((v) => v.outlier).length)} left out` }]),
      ...(warp.length === 0 ? [] : [{ label: "Warp of the board", value: `${warp.map((w) => significant(w * 1000, 2)).join(", ")} mm` }]),
    ]);
    parameterTable(r, s);
    pairTable(r, s);
    lensTable(r, s);
    targetTables(r, s);
    calibrationScene(r, s);
    if (r.turntable)
      s.paragraph(
        `The axis of the turntable is known to ${significant(1000 * (r.turntable.direction_sigma_clustered_rad ?? NaN), 2)} mrad in direction ` +
          `and ${length(r.turntable.point_sigma_clustered_m, null, 2)} across it (σ by frame).`,
      );
    s.heading("Residuals");
    errorsByView(r, s);
    errorsByFrame(r, s);
    quiverByCamera(r, s);
    residualScatter(r, s);
    normalCurve(r, s);
    boardResiduals(r, s);
    s.heading("Coverage and uncertainty");
    coverage(r, s);
    projectionSigma(r, s);
    halfSetDifference(r, s);
    modelDifference(r, s);
    triangulationCurves(r, s);
    correlationMatrix(r, s);
    s.heading("Views");
    viewTables(r, s);
  },
});
