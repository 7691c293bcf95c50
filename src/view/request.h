/* A request to the local server: its head is checked before its body is read.
 * SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WT_VIEW_REQUEST_H
#define WT_VIEW_REQUEST_H

#include <stdbool.h>
#include <stddef.h>

/* Limits of a request [bytes]. */
enum {
    VIEW_TARGET_LIMIT = 4096,
    VIEW_BODY_LIMIT = 4 << 20,
    VIEW_FILE_LIMIT = 64 << 20, /* of a data file that is added */
    VIEW_TOKEN_LENGTH = 32
};

typedef enum view_action {
    VIEW_FILE,      /* a file of the page */
    VIEW_STATE,     /* case, overrides, files and results */
    VIEW_INFO,      /* content of an input file, by its number */
    VIEW_TABLE,     /* a table of the result */
    VIEW_REPORT,    /* the page that report wrote */
    VIEW_PROGRESS,  /* state of the program that the server started */
    VIEW_CHECK,     /* checks the text of a case */
    VIEW_TRIAL,     /* runs the text of a case for some tables */
    VIEW_CURVE,     /* fits one curve as the text of a case requests */
    VIEW_CASE,      /* writes the case */
    VIEW_OVERRIDES, /* writes the manual overrides */
    VIEW_ADD,       /* writes a new data file */
    VIEW_NEW_CASE,  /* starts weartrack new-case */
    VIEW_RUN,       /* starts weartrack run */
    VIEW_STOP,      /* ends the started program */
    VIEW_ALIVE,     /* a page is open */
    VIEW_LEAVE,     /* a page is closed */
    VIEW_ACTIONS
} view_action;

/* What the client sent; missing headers are NULL. */
typedef struct view_head {
    const char *method, *target, *host, *origin;
    const char *site; /* header Sec-Fetch-Site */
} view_head;

typedef struct view_request {
    view_action action;
    char name[256]; /* of an embedded or a new file, or names of tables separated by blanks */
    char group[64], file[1024];
    size_t number;        /* of a file or a curve */
    double contact_point; /* [m]; NaN: fitted */
    unsigned replicates;  /* draws of a trial */
    char digest[65];      /* SHA-256 of the text that the page replaces */
    char page[33];        /* random name of a page */
} view_request;

/* Parses and checks the head of a request for the server on this port. Returns the HTTP status:
 * 200, or the reason for the refusal. */
unsigned view_request_parse(const view_head *head, const char *token, unsigned port,
                            view_request *request);

#endif
