/* Options for rubber, counter surface and conditions, shared by `friction`, `layer` and `identify`.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_SLIDING_OPTIONS_H
#define WT_CMD_SLIDING_OPTIONS_H

#include "cmd/cmd.h"

/* Sources of rubber and counter surface. */
typedef struct cmd_contact {
    const char *material;         /* output of `master`, a table of moduli or a law */
    const char *const *dma_files; /* [n_dma] or DMA files */
    size_t n_dma;
    const char *roughness;
    const char *softening;        /* output of `payne` or a table; NULL: none */
    double softening_temperature; /* selects sweeps by temperature [K]; NaN: all have one
                                     temperature */
    const char *layer_comparison; /* output of `compare`: layer modulus by rate; NULL: none */
    const char *wear_of;          /* output of `record`: specific wear rate; NULL: none */
} cmd_contact;

/* Options for DMA files, which weartrack master documents. */
#define CMD_DMA_OPTIONS                                                                            \
    "shift-law reference-temperature vertical-shift temperature temperature-in-name units format " \
    "sheet deformation sample conditioning"

/* Option groups; CMD_SUBCOMMAND has those of the subcommand itself. */
enum {
    CMD_CONTACT,
    CMD_CONDITIONS,
    CMD_SUBCOMMAND,
    CMD_WORK,
    CMD_MASTER,
    CMD_READ,
    CMD_SLIDING_PARTS
};

typedef struct cmd_sliding {
    cmd_contact contact;
    wt_sliding conditions;
    wt_master_job master;
    wt_file_set set;
    cmd_session session;
    cmd_option_group parts[CMD_SLIDING_PARTS];
    /* set by cmd_sliding_open */
    wt_result *material_tables, *layer_tables;
    wt_estimate measured_wear; /* from wear_of; value NaN: none */
    wt_rubber rubber;
    wt_surface surface;
    wt_strain_softening strain_softening;
} cmd_sliding;

/* Initialises; `own` has the options of the subcommand itself. */
void cmd_sliding_init(cmd_sliding *s, cmd_option_group own);
int cmd_sliding_free(cmd_sliding *s); /* as cmd_session_free */
/* As cmd_parse. */
bool cmd_sliding_parse(cmd_sliding *s, const cmd_usage *usage, int argc, char **argv);
/* Begins the session, reads material and roughness and fills `conditions`. False on failure, which
 * has been reported. */
bool cmd_sliding_open(cmd_sliding *s);
/* Sets the specific wear rate from --wear-of if none is given. A given one takes precedence, with a
 * warning that states the ratio. */
void cmd_sliding_set_wear_rate(cmd_sliding *s, wt_estimate *rate);
/* True if the call states the modulus of a layer; `part` has the layer options. */
bool cmd_sliding_has_layer(const cmd_sliding *s, const cmd_option_group *part);

#endif
