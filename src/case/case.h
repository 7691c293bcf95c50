/* Contents of a case file, in SI units. Internal to case. SPDX-License-Identifier:
 * GPL-3.0-or-later */
#ifndef WT_CASE_CASE_H
#define WT_CASE_CASE_H

#include "case/resources.h"
#include "core/base/array.h"
#include "weartrack/case.h"

/* Input files of one role, such as the bulk curves. */
typedef struct case_files {
    wt_file_set *sets;
    size_t n; /* 0 if the case has none */
    wt_estimate spring_constant,
        sensitivity; /* of the group; the value is NaN if the files state it */
    double lever_error, sensitivity_error; /* largest relative standard errors that the files state;
                                              NaN if a file states none */
    struct case_files *next;               /* next role */
} case_files;

/* WLF constants at the reference temperature of the DMA. */
typedef struct case_wlf {
    wt_estimate c1, c2;
} case_wlf;

/* A structure with parameters that the case has set. wt_case_free frees their lists. */
typedef struct case_setting {
    const wt_params *params;
    void *structure;
    uint64_t given;
    struct case_setting *next;
} case_setting;

struct wt_case {
    arena memory;           /* owns everything in the case */
    case_setting *settings; /* linked list, the last setting first */
    case_files *roles;      /* roles with files, the last role first */
    const char *path, *folder;
    const char *xml; /* bytes of the case file */
    size_t xml_length;
    const char *title; /* "" if not stated, like the next two */
    const char *sample, *condition;

    wt_indent_job indent;   /* the run sets the files of this job and of the others */
    wt_compare_job compare; /* the run sets the tables of this job */
    case_files bulk, track;

    case_files dma;
    wt_master_job master;
    wt_ramp_job ramp;
    bool has_material; /* stated instead of measured, as `kind` */
    wt_rubber_kind kind;
    wt_prony prony;    /* its arrays are in `memory` */
    case_files points; /* one file */
    wt_zener zener;
    bool is_transverse;
    wt_transverse transverse;
    bool has_wlf;
    case_wlf wlf;

    bool has_self_affine, has_spectrum;
    wt_surface surface;  /* self-affine law, or cut-offs and error of the spectrum */
    case_files spectrum; /* one file */
    case_files height_maps;
    wt_topography_job topography; /* for `height_maps` */

    bool has_sliding;
    wt_sliding sliding;
    bool softens; /* the rubber softens with strain */
    case_files
        softening; /* table of the softening; without files the strain sweeps of `dma` are used */

    bool has_layer;
    wt_layer_job layer;
    bool has_modulus_ratio; /* stated instead of measured */
    wt_layer_observation layer_observation;
    bool identifies;
    wt_identify_job identify;

    case_files record, profile; /* `profile` has one pattern */
    wt_record_job records;
    bool has_wear; /* the wear volume is stated */
    wt_validation_job validation;

    bool has_compare; /* the next three flags select the comparisons; otherwise all possible ones
                         run */
    bool compare_groups, compare_rates, compare_dma;

    wt_report_options report;
    bool is_explicit_request; /* the request comes from a call and overrides the case file */
    bool has_requests;        /* otherwise all tables are requested */
    flow_resource_set requested;
};

/* Parses a case file from memory. `path` gives the name for messages and the folder of the input
 * files. */
wt_status case_from_bytes(const void *bytes, size_t length, const char *path, wt_case **out,
                          wt_error *err) WT_NODISCARD;

#endif
