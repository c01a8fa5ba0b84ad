; Boxes with instruments are stacked on a table, and one gripper moves them.
(define (domain trays)
  (:requirements :strips :typing)
  (:types box)
  (:predicates (on ?x - box ?y - box) (on-table ?x - box) (free ?x - box) (empty) (holds ?x - box))

  (:action lift
    :parameters (?x - box)
    :precondition (and (free ?x) (on-table ?x) (empty))
    :effect (and (holds ?x) (not (on-table ?x)) (not (free ?x)) (not (empty))))

  (:action lower
    :parameters (?x - box)
    :precondition (holds ?x)
    :effect (and (on-table ?x) (free ?x) (empty) (not (holds ?x))))

  (:action stack
    :parameters (?x - box ?y - box)
    :precondition (and (holds ?x) (free ?y))
    :effect (and (on ?x ?y) (free ?x) (empty) (not (holds ?x)) (not (free ?y))))

  (:action unstack
    :parameters (?x - box ?y - box)
    :precondition (and (on ?x ?y) (free ?x) (empty))
    :effect (and (holds ?x) (free ?y) (not (on ?x ?y)) (not (free ?x)) (not (empty)))))
