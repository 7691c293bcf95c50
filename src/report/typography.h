/* Typography of the page for texts that are stored or printed in ASCII.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_REPORT_TYPOGRAPHY_H
#define WT_REPORT_TYPOGRAPHY_H

#include "report/report_text.h"

/* Appends an ASCII text as escaped HTML with the signs of the page: "−2.9 °C" for "-2.9 degC",
 * "µm" for "um", "m³" for "m^3", "8.9×10⁻¹³" for "8.9e-13". Other text is not changed. */
void text_typographic(text_buffer *text, const char *ascii);

#endif
