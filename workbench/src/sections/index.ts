// The sections in pipeline order; the strip at the head of the page shows them in this order too.

import { build } from "./build";
import { calibrate } from "./calibrate";
import { describe } from "./describe";
import { fit } from "./fit";
import { reconstruct } from "./reconstruct";
import type { SectionModule } from "./section";
import { simulate } from "./simulate";

export const sections: readonly SectionModule[] = [calibrate, reconstruct, fit, build, describe, simulate];
