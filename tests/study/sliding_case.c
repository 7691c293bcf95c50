/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sliding_case.h"

FILE *sliding_case_begin(const char *path, const contact *stated, double error)
{
    const rubber lines = rubber_make(RUBBER_LINES);
    FILE *out = fopen(path, "w");
    if (out == NULL)
        return NULL;
    fprintf(out,
            "<case version=\"1\"><dma><poisson-ratio>%g</poisson-ratio><reference-temperature>"
            "%gdegC</reference-temperature><prony deformation=\"tension\"><equilibrium>%.12gPa"
            "</equilibrium>",
            stated->poisson, stated->temperature, lines.equilibrium);
    for (size_t i = 0; i < lines.n; i++)
        fprintf(out, "<term time=\"%.12gs\" modulus=\"%.12gPa\"/>", lines.tau[i],
                lines.strength[i]);
    fprintf(out,
            "</prony></dma><roughness><self-affine><q0>%grad/m</q0><qr>%grad/m</qr><q1>%grad/m"
            "</q1><hurst>%g</hurst><c0>%gm^4 +- %g%%</c0></self-affine></roughness>",
            stated->q0, stated->qr, stated->q1, stated->hurst, stated->c0, 100 * error);
    return out;
}
