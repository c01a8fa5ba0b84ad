; Patients lie in beds and are moved to beds that nobody lies in. An isolated room takes one only.
(define (domain beds)
  (:requirements :strips :typing :negative-preconditions :universal-preconditions)
  (:types person place - object patient porter - person bed corridor - place)
  (:constants hall - corridor)
  (:predicates (at ?p - person ?x - place) (isolated ?b - bed) (ill ?p - patient))

  (:action bring
    :parameters (?w - porter ?p - patient ?x ?y - bed)
    :precondition (and (at ?w hall) (at ?p ?x) (forall (?q - patient) (not (at ?q ?y)))
                       (forall (?b - bed) (imply (and (isolated ?b) (ill ?p)) (not (at ?p ?b)))))
    :effect (and (at ?p ?y) (not (at ?p ?x))))

  (:action cure
    :parameters (?p - patient ?b - bed)
    :precondition (and (ill ?p) (at ?p ?b) (isolated ?b))
    :effect (not (ill ?p)))

  (:action rest
    :parameters (?w - porter ?b - bed)
    :precondition (and (at ?w hall) (not (isolated ?b)))
    :effect (and (not (at ?w hall)) (at ?w ?b)))

  (:action rise
    :parameters (?w - porter ?x - (either bed corridor))
    :precondition (at ?w ?x)
    :effect (and (not (at ?w ?x)) (at ?w hall))))
