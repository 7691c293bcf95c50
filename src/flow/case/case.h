/* What a case file says, in SI units. Internal to flow.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WEARTRACK_FLOW_CASE_H
#define WEARTRACK_FLOW_CASE_H

#include "weartrack/flow.h"

/* Files of one role. */
typedef struct case_files {
    wt_file_set *sets;
    size_t n;                    /* 0 = not in the case */
    wt_estimate spring_constant; /* of the group; value NaN = as in the files */
} case_files;

struct wt_case {
    void **blocks; /* everything the case owns, freed together */
    size_t n_blocks, blocks_capacity;
    const char *path, *folder;
    const char *xml; /* the file as it was read */
    size_t xml_length;
    const char *title, *style; /* "" and NULL if not given */

    bool has_tip;
    wt_tip tip;
    wt_indent_options indent;
    double indentation_temperature; /* [K], NaN = not said */
    case_files bulk, track;

    case_files dma;
    wt_shift_options shift;
    wt_prony_options prony_options;
    double poisson_ratio;
    bool has_prony; /* given inline */
    wt_prony prony; /* its arrays are among the blocks */
    bool has_wlf;
    double c1, c2, c1_error, c2_error;

    bool has_self_affine, has_spectrum;
    wt_surface self_affine;
    case_files spectrum; /* one file */
    double spectrum_q0, spectrum_q1, spectrum_error;

    bool has_sliding;
    wt_sliding sliding; /* rubber and surface are set when it runs */
    bool reference_velocity_given;

    bool has_layer;
    wt_layer_job layer;
    double layer_velocity;     /* [m/s], NaN = the reference velocity */
    wt_estimate modulus_ratio; /* given instead of measured; value NaN = not */

    bool has_compare; /* the next three say what; else all that is possible */
    bool compare_groups, compare_rates, compare_dma;

    const char **asked; /* [n_asked] tables asked for by name or through a figure */
    size_t n_asked;
};

/* Zeroed memory that lives as long as the case; NULL when out of memory. */
void *case_alloc(wt_case *c, size_t size);
char *case_text(wt_case *c, const char *text, size_t length);

/* A case from the bytes of its file; `path` names it and its folder. */
wt_status case_from_bytes(const void *bytes, size_t length, const char *path, wt_case **out,
                          wt_error *err) WT_NODISCARD;

/* The whole file `bytes` to a case; `c` has path, folder and xml set. */
wt_status case_parse(wt_case *c, wt_error *err) WT_NODISCARD;

#endif
