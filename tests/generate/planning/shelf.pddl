; Without types: things lie on a shelf of places, and one hand puts one beside another.
(define (domain shelf)
  (:requirements :strips :equality)
  (:predicates (thing ?x) (place ?x) (in ?x ?y) (full ?y) (next ?y ?z) (held ?x) (idle))

  (:action grasp
    :parameters (?x ?y)
    :precondition (and (thing ?x) (place ?y) (in ?x ?y) (idle))
    :effect (and (held ?x) (not (in ?x ?y)) (not (full ?y)) (not (idle))))

  (:action put
    :parameters (?x ?y)
    :precondition (and (held ?x) (place ?y) (not (full ?y)))
    :effect (and (in ?x ?y) (full ?y) (idle) (not (held ?x))))

  (:action swap
    :parameters (?x ?y ?a ?b)
    :precondition (and (thing ?x) (thing ?y) (not (= ?x ?y)) (next ?a ?b) (in ?x ?a) (in ?y ?b) (idle))
    :effect (and (not (in ?x ?a)) (not (in ?y ?b)) (in ?x ?b) (in ?y ?a))))
