/* What a case file says, in SI units. Internal to case.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CASE_CASE_H
#define WT_CASE_CASE_H

#include "case/resources.h"
#include "core/base/arena.h"
#include "weartrack/flow.h"
#include "weartrack/report.h"

/* Files of one role. */
typedef struct case_files {
    wt_file_set *sets;
    size_t n;                                 /* 0 = not in the case */
    wt_estimate spring_constant, sensitivity; /* of the group; value NaN = as in the files */
    double lever_error, sensitivity_error; /* relative, the largest that its files state; NaN: one
                                              of them states none */
    struct case_files *next;               /* of another role */
} case_files;

/* Constants at the reference temperature of the DMA. */
typedef struct case_wlf {
    wt_estimate c1, c2;
} case_wlf;

/* A structure whose parameters the case has set, for its lists. */
typedef struct case_setting {
    const wt_params *params;
    void *structure;
    uint64_t given;
    struct case_setting *next;
} case_setting;

struct wt_case {
    arena memory;           /* of everything the case owns */
    case_setting *settings; /* the last one first */
    case_files *roles;      /* that have files, likewise */
    const char *path, *folder;
    const char *xml; /* the file as it was read */
    size_t xml_length;
    const char *title; /* "" if not given, and these */
    const char *sample, *condition;

    wt_indent_job indent;   /* files are set when it runs; likewise in the others */
    wt_compare_job compare; /* the same for its tables */
    case_files bulk, track;

    case_files dma;
    wt_master_job master;
    wt_ramp_job ramp;
    wt_rubber_options rubber;
    bool has_material; /* given, not measured, as a */
    wt_rubber_kind kind;
    wt_prony prony;    /* its arrays are in the memory of the case */
    case_files points; /* one file */
    wt_zener zener;
    bool is_transverse;
    wt_transverse transverse;
    bool has_wlf;
    case_wlf wlf;

    bool has_self_affine, has_spectrum;
    wt_surface surface;  /* the law, or the cut-offs and the error of the spectrum */
    case_files spectrum; /* one file */
    case_files height_maps;
    wt_topography_job topography; /* of them */

    bool has_sliding;
    wt_sliding sliding;
    bool softens;         /* with strain: */
    case_files softening; /* a table, else by the strain sweeps of `dma` */

    bool has_layer;
    wt_layer_job layer;
    bool has_modulus_ratio; /* given instead of measured */
    wt_layer_observation known;
    struct wt_case *layer_material; /* the layer's own, a case of nothing else; NULL: none */
    bool identifies;
    wt_identify_job identify;

    case_files record, profile; /* of the second one pattern */
    wt_record_job records;
    bool has_wear; /* what is worn is given */
    wt_validation_job validation;

    bool has_compare; /* the next three say what; else all that is possible */
    bool compare_groups, compare_rates, compare_dma;

    wt_report_options report;
    bool called;    /* by a call that says what it wants, whatever the case asks for */
    bool has_asked; /* else all tables are wanted */
    flow_things asked;
};

/* A case in which nothing is given; NULL when out of memory. */
wt_case *case_new(void);
/* A case from the bytes of its file; `path` names it and its folder. */
wt_status case_from_bytes(const void *bytes, size_t length, const char *path, wt_case **out,
                          wt_error *err) WT_NODISCARD;

#endif
