/* The sweeps of frequency, temperature and strain in a table. Internal to the text engine.
 *
 * SPDX-License-Identifier: GPL-3.0-or-later
 */
#ifndef WT_READ_TEXT_SWEEP_H
#define WT_READ_TEXT_SWEEP_H

#include "read/text/text.h"

/* Instruments hold a set frequency better than this; what differs by less is the same one. */
#define SAME_FREQUENCY 0.01

typedef struct sweep_columns {
    const text_column *frequency, *storage, *loss, *magnitude, *factor, *temperature, *strain,
        *time, *step;  /* step: relaxation modulus or creep compliance */
    double to_angular; /* 2 pi for a frequency in Hz */
    wt_loading loading;
    wt_deformation deformation;
    bool has_storage, has_loss; /* measured, or following from what was */
} sweep_columns;

typedef struct sweep_builder {
    const text_file *file;
    const text_table *table;
    sweep_columns c;
    const wt_read_options *options;
    wt_log *log;
    wt_sweep *sweep;
    size_t *rows; /* [n] of the isotherm or the temperature sweep that is being collected */
    size_t n;
    bool steps;           /* only tables of relaxation or creep are read, else only others */
    bool lacks_frequency; /* of the table, and nobody says it */
    bool amplitudes;      /* they took turns, so that an isotherm has its own in its name */
    size_t sample;        /* of the rows, or NO_SAMPLE */
    wt_error *err;
} sweep_builder;

/* ---- text_sweep_row.c */
sweep_columns sweep_find_columns(const text_table *table, wt_read_deformation said);
/* What the sweeps of the table have beside their moduli, for wt_sweep_add. */
unsigned sweep_arrays(const sweep_columns *c);
/* NaN without such a column. */
double sweep_factor(const sweep_builder *b, size_t row);
double sweep_angular(const sweep_builder *b, size_t row);
double sweep_storage(const sweep_builder *b, size_t row);
double sweep_loss(const sweep_builder *b, size_t row);
double sweep_temperature(const sweep_builder *b, size_t row);
/* 1: the frequency rises from one row to another, -1: it falls, 0: it is the same. */
int sweep_way(const sweep_builder *b, size_t from, size_t to);
/* Whether the row has a frequency and all that the table can give. */
bool sweep_is_point(const sweep_builder *b, size_t row);
/* "FILE, TITLE OF THE STEP". */
void sweep_source(const sweep_builder *b, char *source, size_t size);
/* Of the rows in `b->rows`: mean and scatter of the column, or what the header or the user says. */
wt_status sweep_set_temperature(const sweep_builder *b, double *temperature, double *spread);

/* ---- text_sweep_check.c: warns of what the table says against itself. */
wt_status sweep_check_table(const text_file *file, text_table *table, wt_log *log, wt_error *err);

/* ---- text_strain.c: takes the rows of strain sweeps out of `rows`, and adds these to the sweep.
 */
wt_status strain_sweeps_take(sweep_builder *b, size_t *rows, size_t *n);

/* ---- text_ramp.c: takes the rows of temperature sweeps out of `rows`, and adds these to the
 * sweep. */
wt_status ramps_take(sweep_builder *b, size_t *rows, size_t *n);

#endif
