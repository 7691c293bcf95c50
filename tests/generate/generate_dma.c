/* DMA isotherms in the layout of a TRIOS LIMS text export.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include "generate.h"

#include <math.h>
#include <stdlib.h>

#define ISOTHERMS 12
#define FREQUENCIES 16
#define NOISE 0.005 /* relative noise of each modulus */

/* Storage and loss modulus in shear at an angular frequency and a temperature. */
static void modulus(const wt_rubber *rubber, double omega, double temperature, double *storage,
                    double *loss)
{
    double z = omega * pow(10, wt_wlf_log_shift(&rubber->law.wlf, temperature));
    double b = truth_vertical(temperature);
    *storage = rubber->prony.equilibrium_modulus;
    *loss = 0;
    for (size_t k = 0; k < rubber->prony.n; k++) {
        double x = z * rubber->prony.relaxation_time[k];
        *storage += rubber->prony.modulus[k] * x * x / (1 + x * x);
        *loss += rubber->prony.modulus[k] * x / (1 + x * x);
    }
    *storage /= b;
    *loss /= b;
}

static void write_step(FILE *out, const wt_rubber *rubber, double celsius, uint64_t *seed)
{
    fprintf(out,
            "[Step]\nStep name\tFrequency sweep (%.1f \xc2\xb0"
            "C)\nNumber of points\t%d\n",
            celsius, FREQUENCIES);
    fputs("Variables\tTemperature\tAngular frequency\tFrequency\tOscillation torque\tStorage "
          "modulus\tLoss modulus\tTan(delta)\n",
          out);
    fputs("Units\t\xc2\xb0"
          "C\trad/s\tHz\t\xc2\xb5N.m\tMPa\tMPa\t\n",
          out);
    for (int i = 0; i < FREQUENCIES; i++) {
        double omega = 0.1 * pow(10, i / 5.0), storage, loss;
        modulus(rubber, omega, celsius + 273.15, &storage, &loss);
        storage *= exp(NOISE * truth_normal(seed));
        loss *= exp(NOISE * truth_normal(seed));
        fprintf(out, "Data point\t%.2f\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\t%.6g\n",
                celsius + 0.02 * truth_normal(seed), omega, omega / (2 * 3.14159265358979323846),
                2e-4 * hypot(storage, loss), storage * 1e-6, loss * 1e-6, loss / storage);
    }
}

int generate_dma(const wt_rubber *rubber, const char *folder, uint64_t variant)
{
    uint64_t seed = 20 + (variant << 32);
    char *path = wt_path_join(folder, "dma.txt");
    FILE *out = path == NULL ? NULL : fopen(path, "w");
    free(path);
    if (out == NULL) {
        perror("dma.txt");
        return -1;
    }
    fputs("[Version]\nTA Instruments LIMS export format version\t0\n[Header]\nInstrument "
          "name\tsynthetic\nRun date\t01/01/2020\n[Sample]\nName\tsynthetic tread rubber\n",
          out);
    for (int i = 0; i < ISOTHERMS; i++)
        write_step(out, rubber, 80 - 10 * i, &seed);
    int bad = ferror(out);
    return fclose(out) != 0 || bad ? -1 : 0;
}
