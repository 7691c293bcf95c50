/* Options about rubber, counter surface and conditions, shared by `friction` and `layer`.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_CMD_SLIDING_OPTIONS_H
#define WT_CMD_SLIDING_OPTIONS_H

#include "cmd/cmd.h"

/* Where the rubber and the counter surface come from. */
typedef struct cmd_contact {
    const char *material;         /* output of `master`, a table of moduli or a law */
    const char *const *dma_files; /* [n_dma] or DMA files */
    size_t n_dma;
    const char *roughness;
    const char *softening;        /* output of `payne` or a table; NULL: none */
    double softening_temperature; /* of its sweeps [K]; NaN: they are of one */
    const char *layer_comparison; /* output of `compare`: the layer's modulus by rate; NULL: none */
    const char *layer_material;   /* output of `master`: the layer's own; likewise */
    const char *wear_of;          /* output of `record`: the specific wear rate; likewise */
} cmd_contact;

/* Options about DMA files, which weartrack master tells. */
#define CMD_DMA_OPTIONS                                                                            \
    "exclude shift-law reference-temperature reference-at vertical-shift expansion "               \
    "terms-per-decade liquid shift-by temperature temperature-in-name units format sheet "         \
    "deformation strain sample sample-by"

/* Parts of the options; CMD_OWN are those of the subcommand itself. */
enum {
    CMD_CONTACT,
    CMD_CONDITIONS,
    CMD_OWN,
    CMD_KNOWN, /* what is on the surface; of those that want it */
    CMD_WORK,
    CMD_MASTER,
    CMD_RUBBER,
    CMD_TRANSVERSE,
    CMD_READ,
    CMD_SLIDING_PARTS
};

typedef struct cmd_sliding {
    cmd_contact contact;
    wt_sliding conditions;
    wt_master_job master;
    wt_rubber_options options;
    wt_transverse transverse;
    wt_layer_observation known;
    wt_file_set set;
    cmd_session session;
    cmd_part parts[CMD_SLIDING_PARTS];
    /* made by cmd_sliding_open */
    wt_result *material_tables, *layer_tables;
    wt_estimate measured_wear; /* by wear_of; value NaN: none */
    wt_rubber rubber, layer_rubber;
    wt_surface surface;
    wt_strain_softening softness;
} cmd_sliding;

/* `own` are the options of the subcommand itself. */
void cmd_sliding_init(cmd_sliding *s, cmd_part own);
int cmd_sliding_free(cmd_sliding *s); /* as cmd_session_free */
/* As cmd_parse. */
bool cmd_sliding_parse(cmd_sliding *s, const cmd_usage *usage, int argc, char **argv);
/* Begins the session, reads material and roughness and fills `conditions`. False if it cannot; what
 * was wrong has been said. */
bool cmd_sliding_open(cmd_sliding *s);
/* The specific wear rate is the one that --wear-of tells where none is given; one that is given
 * stands, and how far the other is from it is said. */
void cmd_sliding_wear(cmd_sliding *s, wt_estimate *rate);
/* Whether the call says what the modulus of a layer is: `part` has the options of what is known. */
bool cmd_sliding_knows_layer(const cmd_sliding *s, const cmd_part *part);

#endif
