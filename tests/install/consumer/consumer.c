/* A small program that uses the installed library as a stranger would.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#include <math.h>
#include <stdio.h>
#include <weartrack/weartrack.h>

int main(void)
{
    wt_error err = WT_ERROR_INIT;
    wt_tip tip;
    if (wt_tip_parse("pyramid:half-angle=35deg,radius=20nm", &tip, &err) != WT_OK) {
        char text[1024];
        wt_error_format(&err, text, sizeof text);
        fprintf(stderr, "%s\n", text);
        return 1;
    }
    double g = 0, slope = 0;
    wt_contact_function(&tip, 70e-9, &g, &slope);
    printf("weartrack %s: G(70 nm) = %.6g m^2\n", wt_version(), g);
    return isfinite(g) && g > 0 ? 0 : 1;
}
