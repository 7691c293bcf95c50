/* Memory of power spectra. SPDX-License-Identifier: GPL-3.0-or-later */
#include "weartrack/core.h"

#include <stdlib.h>

void wt_noise_spectrum_clear(wt_noise_spectrum *spectrum)
{
    if (spectrum == NULL)
        return;
    free(spectrum->frequency);
    free(spectrum->density);
    *spectrum = (wt_noise_spectrum){.n = 0};
}

void wt_power_spectrum_clear(wt_power_spectrum *spectrum)
{
    if (spectrum == NULL)
        return;
    free(spectrum->wavenumber);
    free(spectrum->density);
    *spectrum = (wt_power_spectrum){0};
}
